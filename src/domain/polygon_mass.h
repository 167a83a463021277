/// The mass of polygons under a density of pixels.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "domain/density_pixels.h"
#include "geometry/polygon_measures.h"
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

struct PolygonMass {
  double mass = 0;
  Point center{0, 0};  ///< of the mass, relative to the polygon's origin; only if there is mass
  double spread = 0;   ///< integral of the squared distance to the center
};

/// Weighs polygons one by one, as specified for measureMass. For one thread; the pixels outlive this object.
class PolygonScale {
 public:
  explicit PolygonScale(const DensityPixels& pixels) : pixels_(pixels) {}

  /// Begins a polygon whose points are relative to `origin` and lie in `around`. If that is within one pixel,
  /// returns its density, and no edges need be added: the mass is density times area.
  std::optional<double> begin(Point origin, const Box& around);

  /// Adds an edge; the polygon lies to its left.
  void add(Point a, Point b) { rows_.add(inPixels(a), inPixels(b)); }

  PolygonMass weigh();

 private:
  [[nodiscard]] Point inPixels(Point p) const {
    return {(p.x - around_.xmin) / pixels_.x.size, (p.y - around_.ymin) / pixels_.y.size};
  }

  const DensityPixels& pixels_;
  Box around_{};
  PixelRows rows_;
};

/// Destination of the moments of cells' masses, by site. It contains those of areas before.
struct MassRecords {
  std::span<const double> area;
  std::span<double> mass;
  std::span<Point> center;     ///< the centroid if there is no mass
  std::span<double> spread{};  ///< integral of the squared distance to the center; empty: not requested
};

/// Computes the moments of mass of cells, one by one. For one thread.
class Weighing {
 public:
  Weighing(const DensityPixels& pixels, const MassRecords& records) : records_(records), scale_(pixels) {}

  /// Weighs the cell of site i, whose vertices are relative to `origin`; each_edge(take) calls take(a, b) for
  /// each of its edges.
  template <class EachEdge>
  void weigh(std::size_t i, Point origin, std::span<const Point> vertices, const EachEdge& each_edge) {
    if (const auto value = scale_.begin(origin, boxOf(vertices))) {
      records_.mass[i] = *value * records_.area[i];
      if (!records_.spread.empty()) records_.spread[i] *= *value;
      return;
    }
    each_edge([this](Point a, Point b) { scale_.add(a, b); });
    const PolygonMass weighed = scale_.weigh();
    records_.mass[i] = weighed.mass;
    if (!records_.spread.empty()) records_.spread[i] = weighed.spread;
    if (!(weighed.mass > 0)) return;
    records_.center[i] = {origin.x + weighed.center.x, origin.y + weighed.center.y};
  }

  /// The same, for one ring.
  void weigh(std::size_t i, Point origin, std::span<const Point> ring) {
    weigh(i, origin, ring, [&](const auto& take) { eachSide(ring, take); });
  }

  /// For a cell without area.
  void weighNothing(std::size_t i) {
    records_.mass[i] = 0;
    if (!records_.spread.empty()) records_.spread[i] = 0;
  }

 private:
  const MassRecords& records_;
  PolygonScale scale_;
};

}  // namespace vorpipe::core
