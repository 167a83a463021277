/// Draws marks over the cells of a picture in pixels.
#pragma once

#include <functional>

#include "picture/overlay.h"
#include "picture/strokes.h"

namespace vorpipe::core {

/// The input of all marks; all of it outlives this.
struct Overlays {
  const RenderOptions& options;
  const Marks& marks;
  const Sites& sites;   ///< of dots, with the images of a periodic domain
  Box box;              ///< what the frame shows, in the unit of these sites
  PictureFrame domain;  ///< where the frame shows the domain
  int threads;
};

/// Draws only cells, in the rows of the frame from `first` to before `last`: an image with several places in
/// each pixel, whose ids are indices of the sites of dots.
using DrawCells = std::function<Result<Image>(int first, int last)>;

/// Draws edges, the dual and dots over the image of a frame, whose pixels have several places each if
/// options.antialias is more than 1. `cells` draws these places. Ids do not change. Errors: those of `cells`.
Result<void> drawOverlays(const Overlays& overlays, const DrawCells& cells, Image& image);

/// Draws labels over a whole picture. `colors` are those of cells, by site.
void drawLabels(const Marks& marks, const RenderOptions& options, std::span<const std::uint32_t> colors,
                Image& image);

}  // namespace vorpipe::core
