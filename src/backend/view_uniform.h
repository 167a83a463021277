/// The uniform block View of shaders/glsl/view.glsl, as every GPU backend fills it.
#pragma once

#include <algorithm>
#include <cmath>

#include "backend/backend.h"
#include "backend/site_texels.h"

namespace vorpipe {

/// As std140 lays the block out.
struct ViewUniform {
  float scale_x, scale_y;         ///< normalized device coordinates per scaled unit
  float outset_x, outset_y;       ///< by how much a cell is widened, in scaled units
  float half_width, half_height;  ///< of the view, in pixels
  float margin;                   ///< by how much a vertex may be off, in pixels
  float padding;
  SiteTexel center;  ///< of the view
};

/// Returns the block for a view drawn by a device that snaps vertices to 1 / 2^subpixel_bits of a pixel.
/// domain is that of the sites whose cells are drawn; without such, any.
///
/// Snapping moves a vertex by up to half a step along each axis. A coordinate that is rounded to float
/// some eight times on its way to the pixel grid is off by as many 2^-25 of the view's size more, which
/// widens the step.
inline ViewUniform viewUniform(const View& view, int subpixel_bits, const Box& domain) {
  const double step = std::ldexp(1.0, -subpixel_bits);
  const auto margin = [step](int pixels) {
    return 0.5 * (step + std::ldexp(static_cast<double>(pixels), -21));
  };
  const double width = view.box.xmax - view.box.xmin;
  const double height = view.box.ymax - view.box.ymin;
  return {static_cast<float>(2.0 / width),
          static_cast<float>(2.0 / height),
          static_cast<float>(margin(view.width) * width / view.width),
          static_cast<float>(margin(view.height) * height / view.height),
          static_cast<float>(0.5 * view.width),
          static_cast<float>(0.5 * view.height),
          static_cast<float>(margin(std::max(view.width, view.height))),
          0.0F,
          siteTexel(domain, (view.box.xmin + view.box.xmax) / 2, (view.box.ymin + view.box.ymax) / 2)};
}

}  // namespace vorpipe
