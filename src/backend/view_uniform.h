/// The uniform block View of shaders/glsl/view.glsl, as every GPU backend fills it.
#pragma once

#include "backend/precision.h"
#include "backend/site_texels.h"
#include "layout.glsl"

namespace vorpipe {

static_assert(REACH_ROUNDING == reach_rounding);

/// The block in std140 layout.
struct ViewUniform {
  float scale_x, scale_y;         ///< normalized device coordinates per scaled unit
  float outset_x, outset_y;       ///< how far a cell is widened, in scaled units; negative: shrunk
  float half_width, half_height;  ///< of the view, in pixels
  float margin;                   ///< largest error of a vertex, in pixels
  float allowed;                  ///< float error allowed in a cell, in scaled units
  SiteTexel center;               ///< of the view
};

/// Returns the block for a view drawn by a device that snaps vertices to 1 / 2^subpixel_bits of a pixel.
/// `domain` is that of the sites whose cells are drawn; without sites, any box.
inline ViewUniform viewUniform(const View& view, int subpixel_bits, const Box& domain) {
  const int longer = std::max(view.width, view.height);
  const auto shares = [&](int pixels) { return pixelShares(pixels, longer, subpixel_bits); };
  const double width = view.box.xmax - view.box.xmin;
  const double height = view.box.ymax - view.box.ymin;
  const PixelShares most = shares(longer);
  return {static_cast<float>(2.0 / width),
          static_cast<float>(2.0 / height),
          static_cast<float>(shares(view.width).outset() * width / view.width),
          static_cast<float>(shares(view.height).outset() * height / view.height),
          static_cast<float>(0.5 * view.width),
          static_cast<float>(0.5 * view.height),
          static_cast<float>(most.snapping + most.rounding),
          static_cast<float>(lossAllowed(view, subpixel_bits)),
          siteTexel(domain, view.corner,
                    {(view.box.xmin + view.box.xmax) / 2, (view.box.ymin + view.box.ymax) / 2})};
}

}  // namespace vorpipe
