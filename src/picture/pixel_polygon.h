/// A convex polygon in the pixels of a view, and what has to be drawn of it.
#pragma once

#include <vector>

#include "backend/backend.h"

namespace vorpipe::core {

/// From positions to pixels of a view: the center of pixel (row, column) is (column + 0.5, row + 0.5), row 0
/// the bottom.
class PixelFrame {
 public:
  /// `subpixel_bits`: vertices are snapped to 1 / 2^subpixel_bits of a pixel.
  PixelFrame(const View& view, int subpixel_bits);

  /// `p`: seen from View::corner.
  [[nodiscard]] Point pixelOf(Point p) const {
    return {(p.x - low_.x) * scale_.x, (p.y - low_.y) * scale_.y};
  }
  /// In normalized device coordinates.
  [[nodiscard]] Point deviceOf(Point pixel) const {
    return {pixel.x * (2 / size_.x) - 1, pixel.y * (2 / size_.y) - 1};
  }
  /// Pixels along each axis.
  [[nodiscard]] Point size() const { return size_; }
  /// By how many pixels a polygon has to be smaller so that it is not too large once its corners are snapped;
  /// 0 where they move by too little to matter.
  [[nodiscard]] double inset() const { return inset_; }
  /// By how many pixels edges may move otherwise.
  [[nodiscard]] double moved() const { return moved_; }

 private:
  Point low_, scale_, size_;
  double inset_, moved_;
};

/// Cuts away what is so far beyond the view that floats would be too coarse for its corners: nothing of what
/// shows changes. Edges that two polygons have in common stay so, to the bit.
void cutToView(const PixelFrame& frame, std::vector<Point>& polygon);

/// Which centers of pixels a polygon holds.
struct CoveredPixels {
  enum class Count : std::uint8_t { none, one, several } count;
  Point center;  ///< of the one
};

/// Counts them, of a polygon with or without corners; `several` may be said of a polygon that is larger than
/// two pixels along an axis and holds none. A center beyond an edge by as little as that may move is inside,
/// so that a cell takes the pixels that its neighbors may lose. `polygon`: counter-clockwise, in pixels.
CoveredPixels coveredPixels(const std::vector<Point>& polygon, const PixelFrame& frame);

/// Shrinks a polygon so that no corner leaves the old one where it is moved by up to `inset` pixels along
/// each axis; false if nothing would remain.
bool shrink(double inset, std::vector<Point>& polygon);

}  // namespace vorpipe::core
