/// Derives the pictures of an input from the options.
#pragma once

#include <optional>
#include <string>

#include "cli/input.h"
#include "cli/options/picture_options.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Returns the size of a picture; while the domain is unknown, a lower bound.
PictureSize sizeOf(const PictureOptions& picture, const std::optional<Box>& domain);

/// Returns what to draw of an input. Errors (input), which name the option: options contradict each other or
/// the input.
Result<RenderOptions> pictureOf(const PictureOptions& picture, const InputOptions& sites, const Input& input);

/// Returns a note that a picture stretches its domain, and how to avoid that. Empty if it does not, or if
/// --fit requested it.
std::string stretchNote(const PictureOptions& picture, const RenderOptions& options);

}  // namespace vorpipe::cli
