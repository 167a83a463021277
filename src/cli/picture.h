/// Pictures of an input, as the options ask for them.
#pragma once

#include <optional>
#include <string>

#include "cli/input.h"
#include "cli/options/picture_options.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// How large a picture will be; while the domain is not known, no larger than it will.
PictureSize sizeOf(const PictureOptions& picture, const std::optional<Box>& domain);

/// What is drawn of an input. Errors (input): options that contradict each other, or the input; they name the
/// option.
Result<RenderOptions> pictureOf(const PictureOptions& picture, const InputOptions& sites, const Input& input);

/// The line that says that a picture stretches its domain, and how not to; empty where it does not, or where
/// --fit asked for it.
std::string stretchNote(const PictureOptions& picture, const RenderOptions& options);

}  // namespace vorpipe::cli
