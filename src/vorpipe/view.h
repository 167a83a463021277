/// What a picture shows of its domain.
#pragma once

#include "vorpipe/picture.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// A picture's view, or its domain where it names none.
const Box& shownBox(const RenderOptions& options);

/// Where a picture shows that: frameOf() about it.
PictureFrame shownFrame(const RenderOptions& options);

/// The pixels of that frame whose centers lie in the domain, from the picture's upper left corner: all others
/// have no site. Where there is none, its width and height are 0.
PictureFrame domainFrame(const RenderOptions& options);

/// Refuses (input) a view that is no rectangle, one of which a pixel is smaller than least_pixel, and one
/// that is larger than largest_view, both as parts of the domain's longer side: doubles and devices tell
/// places in such a picture apart no longer.
Result<void> checkView(const RenderOptions& options);

inline constexpr double least_pixel = 1e-13, largest_view = 1e9;

}  // namespace vorpipe
