#include "core/moving/outlined_cells.h"

#include <algorithm>
#include <optional>

#include "base/parallel.h"
#include "core/cells/cell_rings.h"
#include "core/moving/weighing.h"
#include "core/outline/clip_cell.h"
#include "core/outline/ring_measures.h"
#include "core/vertices/cell_walk.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 4096;

/// What cells are measured from, and to where.
struct OutlinedRun {
  const OwnCorners& cells;
  const OutlineIndex& index;
  const CellsThatMeet& meet;
  const CellPolygons& polygons;
  CellMoments& moments;
};

/// Measures one cell after the other. For one thread.
class OutlinedMeasures {
 public:
  OutlinedMeasures(const OutlinedRun& run, const DensityPixels* pixels) : run_(run), clip_(run.index) {
    if (pixels != nullptr) weighing_.emplace(*pixels, run.moments);
  }

  void measure(std::uint32_t cell, std::span<const AnchoredPoint> corners) {
    const auto i = run_.cells.set.id[cell];
    if (run_.moments.status[i] != Status::ok) return;
    placeCorners(corners);
    switch (partOf(i)) {
      case Part::whole:
        return takeWhole(i, cell, corners);
      case Part::cut:
        return takeCut(i);
      case Part::unsure:
        return takePolygon(i);
    }
  }

 private:
  enum class Part : std::uint8_t {
    whole,
    cut,     ///< as `clipped_` is
    unsure,  ///< the diagram says otherwise
  };

  /// Rounded, and each place once.
  void placeCorners(std::span<const AnchoredPoint> corners) {
    points_.clear();
    for (const auto& corner : corners) {
      const Point p = positionOf(corner);
      if (points_.empty() || points_.back() != p) points_.push_back(p);
    }
    while (points_.size() > 1 && points_.back() == points_.front()) points_.pop_back();
  }

  Part partOf(std::size_t i) {
    const auto begin = run_.meet.offsets[i], end = run_.meet.offsets[i + 1];
    const auto neighbors = std::span(run_.meet.neighbors).subspan(begin, end - begin);
    if (std::ranges::none_of(neighbors, [](std::int64_t j) { return j < 0; })) return Part::whole;
    run_.index.edgesIn(boxOf(points_), near_);
    if (near_.empty()) return Part::whole;
    if (points_.size() < 3) return Part::unsure;
    labels_.assign(points_.size(), 0);
    const auto outcome = clip_.clip(points_, labels_, near_, clipped_);
    if (outcome == OutlineClip::Outcome::cut) return Part::cut;
    // Ties that are turned around may make the polygon cross itself: then it is not clipped.
    const bool is_cut = std::ranges::count(neighbors, std::int64_t{wall_outline}) > 0;
    return outcome == OutlineClip::Outcome::inside && !is_cut ? Part::whole : Part::unsure;
  }

  void takeWhole(std::size_t i, std::uint32_t cell, std::span<const AnchoredPoint> corners) {
    const Point origin = measuringOrigin(run_.cells.set, cell, corners.front());
    write(i, origin, measureCell(origin, corners));
    if (!weighing_) return;
    for (Point& p : points_) p = run_.cells.unscale(p);
    weighing_->weigh(i, {0, 0}, points_);
  }

  void takeCut(std::size_t i) {
    RingMeasures measures;
    const Point origin = clipped_.vertices.front();
    for (std::size_t r = 0; r < clipped_.ring_starts.size(); ++r) {
      points_.clear();
      for (const Point p : clipped_.ring(r)) points_.push_back({p.x - origin.x, p.y - origin.y});
      measures.add(points_, clipped_.hole[r]);
    }
    write(i, origin, measures.total());
    if (!weighing_) return;
    for (Point& p : clipped_.vertices) p = run_.cells.unscale(p);
    weighing_->weigh(i, {0, 0}, clipped_.vertices, [&](const auto& take) {
      for (std::size_t r = 0; r < clipped_.ring_starts.size(); ++r) {
        const auto ring = clipped_.ring(r);
        for (std::size_t k = 0; k < ring.size(); ++k) take(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]);
      }
    });
  }

  /// Leaves the area as it is.
  void takePolygon(std::size_t i) {
    if (!weighing_) return;
    const auto begin = run_.meet.offsets[i], end = run_.meet.offsets[i + 1];
    const auto& vertices = run_.polygons.vertices;
    const auto own = begin < end ? std::span(vertices).subspan(begin, end - begin)
                                 : std::span<const Point>(&run_.moments.centroid[i], 1);
    weighing_->weigh(i, {0, 0}, own, [&](const auto& take) {
      eachEdge(run_.polygons.ring_starts, begin, end,
               [&](std::uint64_t v, std::uint64_t next) { take(vertices[v], vertices[next]); });
    });
  }

  void write(std::size_t i, Point origin, const Measures& m) {
    const Unscale& unscale = run_.cells.unscale;
    run_.moments.area[i] = run_.moments.mass[i] = unscale(m.area, 2);
    run_.moments.spread[i] = unscale(spreadOf(m), 4);
    run_.moments.centroid[i] = unscale(Point{origin.x + m.centroid.x, origin.y + m.centroid.y});
  }

  const OutlinedRun& run_;
  OutlineClip clip_;
  std::optional<Weighing> weighing_;
  std::vector<Point> points_;
  std::vector<std::int64_t> labels_;
  std::vector<std::uint32_t> near_;
  ClippedCell clipped_;
};

}  // namespace

Result<void> measureOutlined(const OwnCorners& cells, const Outline& outline, int exponent,
                             const CellsThatMeet& meet, const CellPolygons& polygons,
                             const DensityPixels* pixels, CellMoments& moments) {
  const auto rings = ringsOf(outline, exponent);
  if (!rings) return tl::unexpected(rings.error());
  const OutlineIndex index(*rings);
  const OutlinedRun run{cells, index, meet, polygons, moments};
  const auto count = cells.set.size();
  parallelFor(count, grainFor(count, grain), cells.threads, [&](std::size_t begin, std::size_t end) {
    OutlinedMeasures measures(run, pixels);
    CellWalk walk(cells.set, cells.rows);
    walk(begin, end, [&](std::uint32_t cell, auto, auto corners) { measures.measure(cell, corners); });
  });
  return {};
}

}  // namespace vorpipe::core
