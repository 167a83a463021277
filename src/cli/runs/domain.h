/// The domain of a run, and the plane that it is in.
#pragma once

#include "cli/runs/input.h"

namespace vorpipe::cli {

/// Finds the domain of the sites in `input`, by --domain, --margin, --repair and --project; the last takes
/// the sites to the plane as well. Notes are what was mended and how far the plane can be trusted. Errors
/// (input): options that contradict each other, a domain that is none.
Result<void> takeDomain(const InputOptions& options, Input& input);

/// Takes a diagram, and the sites of the input that it is of, from the plane of --project back to degrees;
/// without that nothing changes.
void backToDegrees(Input& input, Diagram& diagram, int threads);

}  // namespace vorpipe::cli
