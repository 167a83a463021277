/// Hard inputs as files, and the commands that run them.
#pragma once

#include <string>

#include "support/hard/hard_runs.h"

namespace vorpipe::test {

/// Writes the sites as `stem`.csv, to the last bit, and an outline as `stem`.wkt beside it. Throws
/// std::runtime_error where a file cannot be written.
void writeHardInput(const HardInput& input, const std::string& stem);

/// The command line that shows a fault of files that were written so.
std::string commandOf(const HardInput& input, const HardFault& fault, const std::string& stem);

}  // namespace vorpipe::test
