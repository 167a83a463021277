/// What a picture shows of its domain.
#pragma once

#include "vorpipe/picture.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// A picture's view, or its domain if it has none; of the globe the box around the whole map.
const Box& shownBox(const RenderOptions& options);

/// The frame of shownBox() in the picture, by frameOf().
PictureFrame shownFrame(const RenderOptions& options);

/// The pixels of that frame whose centers lie in the domain, from the picture's upper left corner; all other
/// pixels have no site. If there are none, its width and height are 0.
PictureFrame domainFrame(const RenderOptions& options);

/// Refuses (input) a view that is no rectangle, has pixels smaller than least_pixel, or is larger than
/// largest_view; both limits are relative to the domain's longer side. Beyond them doubles and devices cannot
/// tell places in such a picture apart.
Result<void> checkView(const RenderOptions& options);

inline constexpr double least_pixel = 1e-13, largest_view = 1e9;

}  // namespace vorpipe
