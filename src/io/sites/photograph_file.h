/// Reads photographs, which give cells their colors, with their place.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/base/coordinate_system.h"
#include "io/sites/site_domain.h"
#include "vorpipe.h"

namespace vorpipe {

struct PhotographFile {
  Photograph photograph{};    ///< with a box if a file beside it gives its place
  CoordinateSystem system{};  ///< of that box
};

/// Whether the path's extension is that of a picture in pixels: .png, .jpg or .jpeg.
bool isPhotograph(std::string_view path);

/// Reads a picture by the path's extension. The pixels lie in `box`; without a box, where a file beside the
/// path says, as for a density. Errors: those of readPng and readJpeg; a wrong file beside it (input).
Result<PhotographFile> readPhotograph(const std::string& path, const std::optional<Box>& box = {});

/// Compares the place with the domain, as placeDensity does; the words are `option` and `box_option`.
Result<void> placePhotograph(const PhotographFile& file, const std::string& path, PlacedSites& placed,
                             DomainWords words, std::string_view option, std::string_view box_option);

}  // namespace vorpipe
