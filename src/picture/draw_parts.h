/// The cells of a picture, drawn in as many views as a device needs.
#pragma once

#include "picture/cell_drawing.h"
#include "picture/shown_part.h"
#include "picture/uncovered.h"

namespace vorpipe::core {

/// What was drawn of a picture, and how.
struct Drawn {
  Image image;
  double download_seconds = 0;
  std::uint64_t uncovered = 0;  ///< pixels that the device left
};

/// `room` is how many pixels the picture will have.
Result<Drawn> drawParts(Backend& backend, CellDrawing& drawing, const NearestSites& nearest,
                        const ShownPart& shown, const Palette& palette, std::size_t room);

/// Which cells are drawn, and by whom. To choose them pays where the others are as many at least.
WhatToDraw whatToDraw(const SiteSet& set, const RenderOptions& options, const ShownPart& shown);

}  // namespace vorpipe::core
