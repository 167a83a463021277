#include "core/moving/own_corners.h"

#include "base/parallel.h"
#include "core/moving/weighing.h"
#include "core/vertices/cell_walk.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 4096;

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
    weighing_.weigh(i, placeOf(i, cell, origin), points_);
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

}  // namespace vorpipe::core
