/// The error allowed in the pixels of a picture, divided among its sources; see docs/algorithm.md, "From
/// cells to pixels".
#pragma once

#include <algorithm>
#include <cmath>

#include "backend/backend.h"

namespace vorpipe {

/// Largest float error of a cell's lines and corners, per unit of distance from its origin to its farthest
/// corner.
inline constexpr double reach_rounding = 40 * 0x1p-24;

/// Shares of a pixel's allowed error, in pixels along one axis.
struct PixelShares {
  /// The total: 1/128 across a bisector of any direction.
  static constexpr double all = 1.0 / 128 / 1.4142135623730951;
  /// The share that even the largest views leave to cells.
  static constexpr double least_lost = 0.0003;

  double snapping;  ///< half a step of the vertex grid
  double rounding;  ///< error of the conversion from view coordinates to pixels
  double lost;      ///< error allowed in the cell itself

  /// Returns how far a cell is widened: as far as vertices move, so that neighbors leave no gap, if the total
  /// allows it. Otherwise cells are drawn smaller; if the result is negative, they are shrunk.
  [[nodiscard]] double outset() const {
    const double moved = snapping + rounding;
    return std::min(moved, all - moved - lost);
  }
};

/// Returns the shares along one axis of a view with `pixels` pixels along it and `longer` along its longer
/// axis. The device snaps vertices to 1 / 2^subpixel_bits of a pixel.
///
/// A coordinate is rounded to float about eight times on its way to the pixel grid, so its error is as many
/// 2^-25 of the view's size. The coarser that grid is, the less a slightly larger error of the cells matters.
inline PixelShares pixelShares(int pixels, int longer, int subpixel_bits) {
  const double snapping = std::ldexp(0.5, -subpixel_bits);
  const auto rounding = [](int side) { return std::ldexp(static_cast<double>(side), -22); };
  const double left = PixelShares::all - 2 * (snapping + rounding(longer));
  constexpr double of_coarse = 1.0 / 16;
  return {snapping, rounding(pixels), std::max({left, PixelShares::least_lost, of_coarse * snapping})};
}

/// Returns the error allowed in a cell of a view, in scaled units.
inline double lossAllowed(const View& view, int subpixel_bits) {
  const int longer = std::max(view.width, view.height);
  return pixelShares(longer, longer, subpixel_bits).lost *
         std::min((view.box.xmax - view.box.xmin) / view.width,
                  (view.box.ymax - view.box.ymin) / view.height);
}

}  // namespace vorpipe
