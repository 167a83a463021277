/// What the pixels of a picture may be off by, shared out among what makes them so; docs/algorithm.md, "From
/// cells to pixels".
#pragma once

#include <algorithm>
#include <cmath>

#include "backend/backend.h"

namespace vorpipe {

/// What floats lose at most of the lines and corners of a cell, for each unit of the way from its origin to
/// its farthest corner.
inline constexpr double reach_rounding = 40 * 0x1p-24;

/// Shares of what a pixel may be off by, in pixels along one axis.
struct PixelShares {
  /// 1/128 in all, across a bisector of any direction.
  static constexpr double all = 1.0 / 128 / 1.4142135623730951;
  /// What even the largest views leave to cells.
  static constexpr double least_lost = 0.0003;

  double snapping;  ///< half a step of the vertex grid
  double rounding;  ///< what is lost on the way from coordinates of the view to its pixels
  double lost;      ///< what may be lost of a cell

  /// By how much a cell is widened: as much as vertices move, so that no gap is left between neighbors, if
  /// that is not too much. Else cells are drawn smaller, and shrunk where this is negative.
  [[nodiscard]] double outset() const {
    const double moved = snapping + rounding;
    return std::min(moved, all - moved - lost);
  }
};

/// The shares along one axis of a view, which has `pixels` pixels along it and `longer` along its longer
/// axis, on a device that snaps vertices to 1 / 2^subpixel_bits of a pixel.
///
/// A coordinate that is rounded to float some eight times on its way to the pixel grid is off by as many
/// 2^-25 of the view's size. The coarser that grid is, the less a little more matters to cells.
inline PixelShares pixelShares(int pixels, int longer, int subpixel_bits) {
  const double snapping = std::ldexp(0.5, -subpixel_bits);
  const auto rounding = [](int side) { return std::ldexp(static_cast<double>(side), -22); };
  const double left = PixelShares::all - 2 * (snapping + rounding(longer));
  constexpr double of_coarse = 1.0 / 16;
  return {snapping, rounding(pixels), std::max({left, PixelShares::least_lost, of_coarse * snapping})};
}

/// What may be lost of a cell in a view, in scaled units.
inline double lossAllowed(const View& view, int subpixel_bits) {
  const int longer = std::max(view.width, view.height);
  return pixelShares(longer, longer, subpixel_bits).lost *
         std::min((view.box.xmax - view.box.xmin) / view.width,
                  (view.box.ymax - view.box.ymin) / view.height);
}

}  // namespace vorpipe
