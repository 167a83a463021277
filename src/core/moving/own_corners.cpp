#include "core/moving/own_corners.h"

#include "base/parallel.h"
#include "core/cells/cell_rings.h"
#include "core/cells/polygon_mass.h"
#include "core/vertices/cell_walk.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 4096;

/// Gives one cell after the other the moments of its mass.
class Weighing {
 public:
  Weighing(const DensityPixels& pixels, CellMoments& moments) : moments_(moments), scale_(pixels) {}

  /// The cell of site i, whose vertices are seen from `origin`. eachEdge(take) calls take(a, b) for its
  /// edges.
  template <class EachEdge>
  void weigh(std::size_t i, Point origin, std::span<const Point> vertices, const EachEdge& each_edge) {
    if (const auto value = scale_.begin(origin, boxOf(vertices))) {
      moments_.mass[i] = *value * moments_.area[i];
      moments_.spread[i] *= *value;
      return;
    }
    each_edge([this](Point a, Point b) { scale_.add(a, b); });
    const PolygonMass weighed = scale_.weigh();
    moments_.mass[i] = weighed.mass;
    moments_.spread[i] = weighed.spread;
    if (!(weighed.mass > 0)) return;
    moments_.centroid[i] = {origin.x + weighed.center.x, origin.y + weighed.center.y};
  }

 private:
  CellMoments& moments_;
  PolygonScale scale_;
};

/// Weighs cells of the set by their own corners.
class OwnMasses {
 public:
  OwnMasses(const OwnCorners& cells, const DensityPixels& pixels, CellMoments& moments)
      : cells_(cells), weighing_(pixels, moments) {}

  void weigh(std::uint32_t cell, std::span<const AnchoredPoint> corners) {
    const auto i = cells_.set.id[cell];
    if (i >= cells_.places.size()) return;
    const Point origin = measuringOrigin(cells_.set, cell, corners.front());
    points_.clear();
    for (const auto& corner : corners) points_.push_back(cells_.unscale(relativeTo(origin, corner)));
    weighing_.weigh(i, placeOf(i, cell, origin), points_, [this](const auto& take) {
      for (std::size_t k = 0; k < points_.size(); ++k) {
        take(points_[k], points_[k + 1 < points_.size() ? k + 1 : 0]);
      }
    });
  }

 private:
  /// Where the origin lies for the caller.
  [[nodiscard]] Point placeOf(std::size_t i, std::uint32_t cell, Point origin) const {
    const Point away{origin.x - cells_.set.x[cell], origin.y - cells_.set.y[cell]};
    const Point way = cells_.unscale(away);
    return {cells_.places.x[i] + way.x, cells_.places.y[i] + way.y};
  }

  const OwnCorners& cells_;
  Weighing weighing_;
  std::vector<Point> points_;
};

}  // namespace

void weighCells(const OwnCorners& cells, const DensityPixels& pixels, CellMoments& moments) {
  const auto count = cells.set.size();
  parallelFor(count, grainFor(count, grain), cells.threads, [&](std::size_t begin, std::size_t end) {
    OwnMasses masses(cells, pixels, moments);
    CellWalk walk(cells.set, cells.rows);
    walk(begin, end, [&](std::uint32_t cell, auto, auto corners) { masses.weigh(cell, corners); });
  });
}

void weighCells(const CellPolygons& polygons, std::span<const std::uint64_t> offsets,
                const DensityPixels& pixels, int threads, CellMoments& moments) {
  const auto count = moments.status.size();
  const auto& vertices = polygons.vertices;
  parallelFor(count, grainFor(count, grain), threads, [&](std::size_t first, std::size_t last) {
    Weighing weighing(pixels, moments);
    for (auto i = first; i < last; ++i) {
      const auto begin = offsets[i], end = offsets[i + 1];
      if (moments.status[i] != Status::ok) continue;
      const auto own = begin < end ? std::span(vertices).subspan(begin, end - begin)
                                   : std::span<const Point>(&moments.centroid[i], 1);
      weighing.weigh(i, {0, 0}, own, [&](const auto& take) {
        eachEdge(polygons.ring_starts, begin, end,
                 [&](std::uint64_t v, std::uint64_t next) { take(vertices[v], vertices[next]); });
      });
    }
  });
}

}  // namespace vorpipe::core
