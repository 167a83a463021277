/// The uniform block View of shaders/glsl/view.glsl, as every GPU backend fills it.
#pragma once

#include <cmath>

#include "backend/backend.h"

namespace vorpipe {

/// As std140 lays the block out.
struct ViewUniform {
  float scale_x, scale_y;    ///< normalized device coordinates per scaled unit
  float outset_x, outset_y;  ///< by how much a cell is widened, in scaled units
};

/// Returns the block for a view drawn by a device that snaps vertices to 1 / 2^subpixel_bits of a pixel.
///
/// Snapping moves a vertex by up to half a step along each axis. A coordinate that is rounded to float
/// on its way to the pixel grid is off by a few 2^-24 of the view's size more, which widens the step.
inline ViewUniform viewUniform(const View& view, int subpixel_bits) {
  const double step = std::ldexp(1.0, -subpixel_bits);
  const auto outset = [step](double length, int pixels) {
    const double rounding = std::ldexp(static_cast<double>(pixels), -22);
    return static_cast<float>(0.5 * (step + rounding) * length / pixels);
  };
  const double width = view.box.xmax - view.box.xmin;
  const double height = view.box.ymax - view.box.ymin;
  return {static_cast<float>(2.0 / width), static_cast<float>(2.0 / height), outset(width, view.width),
          outset(height, view.height)};
}

}  // namespace vorpipe
