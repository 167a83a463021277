/// A convex polygon in the pixels of a view, and how to draw it.
#pragma once

#include <vector>

#include "backend/backend.h"

namespace vorpipe::core {

/// Maps positions to pixels of a view: the center of pixel (row, column) is (column + 0.5, row + 0.5), row 0
/// is the bottom.
class PixelFrame {
 public:
  /// `subpixel_bits`: vertices are snapped to 1 / 2^subpixel_bits of a pixel.
  PixelFrame(const View& view, int subpixel_bits);

  /// `p` is relative to View::corner.
  [[nodiscard]] Point pixelOf(Point p) const {
    return {(p.x - low_.x) * scale_.x, (p.y - low_.y) * scale_.y};
  }
  /// In normalized device coordinates.
  [[nodiscard]] Point deviceOf(Point pixel) const {
    return {pixel.x * (2 / size_.x) - 1, pixel.y * (2 / size_.y) - 1};
  }
  /// Pixels along each axis.
  [[nodiscard]] Point size() const { return size_; }
  /// Number of pixels by which to shrink a polygon so that snapping its corners does not make it too large; 0
  /// if snapping is too small to matter.
  [[nodiscard]] double erosion() const { return erosion_; }
  /// Number of pixels by which edges may move otherwise.
  [[nodiscard]] double moved() const { return moved_; }

 private:
  Point low_, scale_, size_;
  double erosion_, moved_;
};

/// Cuts away parts so far beyond the view that floats would be too coarse for their corners. Visible parts do
/// not change. Shared edges of two polygons stay equal to the bit.
void cutToView(const PixelFrame& frame, std::vector<Point>& polygon);

/// The pixel centers inside a polygon.
struct CoveredPixels {
  enum class Count : std::uint8_t { none, one, several } count;
  Point center;  ///< of the single pixel
};

/// Counts pixel centers in a polygon with or without corners. May return `several` for a polygon that is
/// larger than two pixels along an axis and holds none. A center beyond an edge by no more than the edge may
/// move is inside, so that a cell takes the pixels that its neighbors may lose. `polygon`: counter-clockwise,
/// in pixels.
CoveredPixels coveredPixels(const std::vector<Point>& polygon, const PixelFrame& frame);

/// Shrinks a polygon so that no corner, moved by up to `erosion` pixels along each axis, leaves the old
/// polygon. Returns false if nothing would remain.
bool shrink(double erosion, std::vector<Point>& polygon);

}  // namespace vorpipe::core
