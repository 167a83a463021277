/// The cells of a picture, drawn in as many views as a device needs.
#pragma once

#include "picture/cell_drawing.h"
#include "picture/shown_part.h"
#include "picture/uncovered.h"

namespace vorpipe::core {

/// The drawn picture and its figures.
struct Drawn {
  Image image;
  double download_seconds = 0;
  std::uint64_t uncovered = 0;  ///< pixels that the device did not cover
};

/// `room` is the number of pixels that the picture will have.
Result<Drawn> drawParts(Backend& backend, CellDrawing& drawing, const NearestSites& nearest,
                        const ShownPart& shown, const Palette& palette, std::size_t room);

/// Decides which cells are drawn, and whether by the device. Selecting cells pays if at least as many others
/// are left out.
WhatToDraw whatToDraw(const SiteSet& set, const RenderOptions& options, const ShownPart& shown);

}  // namespace vorpipe::core
