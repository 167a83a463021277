/// Draws marks over the cells of a picture in pixels, and smooths it.
#pragma once

#include <functional>

#include "picture/overlay.h"

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

/// Draws the rows of a frame from `first` to before `last` as an image with several rows and columns of
/// samples in each pixel. Its ids are indices of the sites of dots.
using DrawRows = std::function<Result<Image>(int first, int last)>;

/// Draws edges, the dual and dots over the image of a frame, whose pixels have several samples each if
/// options.antialias is more than 1. `cells` draws these samples. Ids do not change. Errors: those of
/// `cells`.
Result<void> drawOverlays(const Overlays& overlays, const DrawRows& cells, Image& image);

/// Gives each pixel of an image the mean color of its samples; its opacity is the share of samples with a
/// site. Ids do not change. Errors: those of `draw`.
Result<void> smooth(const DrawRows& draw, int in_pixel, int threads, Image& image);

/// Puts the image of a frame into the picture, over its background, and draws labels and a legend inside. Ids
/// are those of sites; `colors` are those of cells, by site.
void completePicture(const RenderOptions& options, const Marks& marks, std::span<const std::uint32_t> colors,
                     const std::optional<ColorKey>& key, int threads, Image& image);

}  // namespace vorpipe::core
