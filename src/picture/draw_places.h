/// Draws the cells of a picture whose pixels have several places.
#pragma once

#include "picture/draw_parts.h"
#include "picture/kept_picture.h"

namespace vorpipe::core {

/// Draws some rows of a picture's frame at a time.
class PlacesDrawing {
 public:
  /// The sites have their colors. All of it outlives this.
  PlacesDrawing(const Machine& machine, const NearestSites& nearest, const RenderOptions& options,
                const Palette& palette, KeptPicture& kept);

  /// Returns the places of the rows from `first` to before `last` of the frame, masked by the outline. Ids
  /// are those of the scene.
  Result<Image> draw(int first, int last);

 private:
  const Machine& machine_;
  const NearestSites& nearest_;
  int in_pixel_;
  RenderOptions options_;  ///< of the frame alone, with one place per pixel
  const Palette& palette_;
  const KeptPicture& kept_;
  ShownPart all_;
  CellDrawing drawing_;
};

}  // namespace vorpipe::core
