/// Integrals over the part of a polygon in each pixel of a grid, row by row.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// Integrals of 1, x, y, and of the squares of x and y.
struct PixelIntegrals {
  double area = 0, x = 0, y = 0, xx = 0, yy = 0;
};

/// Rings over a grid of pixels. Grid lines of columns lie at column - offset.x, those of rows at row -
/// offset.y. Points have nonnegative x and y; places beyond the first and last row and column count as in
/// them.
///
/// Edges are cut at the grid lines. Each piece adds to its pixel the region between it and the pixel's left
/// side, and adds its height to all pixels to the left. Heights are integers, so they add up exactly: a pixel
/// that the rings do not touch gets exactly nothing, and one inside gets all of it.
class PixelRows {
 public:
  struct Range {
    std::int64_t first, last;
  };

  /// Begins a polygon of this height, over these columns and rows.
  void begin(Point offset, double height, Range columns, Range rows);
  /// Adds the edge from a to b; the polygon lies to its left.
  void add(Point a, Point b);

  /// Calls take(row, column, integrals) for each pixel that the rings may touch.
  template <class Take>
  void integrate(const Take& take) {
    beginRows();
    for (auto row = rows_.first; row <= rows_.last; ++row) {
      gatherRow(row);
      Carry carry;
      for (auto column = touched_.last; column >= touched_.first; --column) {
        const PixelIntegrals pixel = pixelOf(column, row, carry);
        if (pixel.area != 0) take(row, column, pixel);
      }
    }
  }

 private:
  using Height = std::int64_t;
  struct Edge {
    double x0, x1;
    Height y0, y1;  ///< y0 < y1
    int sign;       ///< 1 upward
  };
  /// The contribution of the edges in a pixel to it, and their heights.
  struct Part {
    PixelIntegrals own;
    Height height = 0;
    double y_height = 0;   ///< integral of y
    double yy_height = 0;  ///< integral of y's square
  };
  struct Carry {
    Height height = 0;
    double y_height = 0, yy_height = 0;
  };

  void beginRows();
  void gatherRow(std::int64_t row);
  void addInRow(const Edge& edge);
  void addPiece(std::int64_t column, double xa, Height ya, double xb, Height yb, int sign);
  PixelIntegrals pixelOf(std::int64_t column, std::int64_t row, Carry& carry);
  [[nodiscard]] std::int64_t columnOf(double x) const;
  [[nodiscard]] double leftOf(std::int64_t column) const;
  [[nodiscard]] Height lineOf(std::int64_t row) const;
  [[nodiscard]] double real(Height y) const { return static_cast<double>(y) * unit_; }

  Point offset_{};
  Range columns_{}, rows_{}, touched_{};
  double unit_ = 1, units_ = 1;  ///< one height unit, in pixels; height units per pixel
  Height low_ = 0, high_ = 0;    ///< of the present row
  std::vector<Edge> edges_, active_;
  std::size_t next_ = 0;  ///< first edge that has not begun
  std::vector<Part> parts_;
};

}  // namespace vorpipe::core
