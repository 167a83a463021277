#include "session/polygon_edges.h"

#include <optional>

#include "base/parallel.h"
#include "domain/cell_rings.h"
#include "domain/segment_density.h"
#include "geometry/polygon_measures.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t polygon_edges_grain = 4096;

class PolygonEdges {
 public:
  PolygonEdges(const CellPolygons& polygons, const CellsThatMeet& meet, const PolygonScene& scene,
               EdgesOfCells& edges)
      : polygons_(polygons),
        meet_(meet),
        places_(scene.places),
        width_(scene.domain.xmax - scene.domain.xmin),
        height_(scene.domain.ymax - scene.domain.ymin),
        edges_(edges) {
    if (!scene.density.values.empty()) pixels_.emplace(scene.density, scene.domain, scene.periodic);
  }

  void cell(std::size_t i) const {
    eachEdge(polygons_.ring_starts, meet_.offsets[i], meet_.offsets[i + 1],
             [&](std::uint64_t v, std::uint64_t next) { edge(i, v, next); });
  }

 private:
  void edge(std::size_t i, std::uint64_t v, std::uint64_t next) const {
    const Point a = polygons_.vertices[v], b = polygons_.vertices[next];
    const SegmentDensity along = pixels_ ? densityAlong(*pixels_, a, b) : SegmentDensity{1, 0.5};
    edges_.middle[v] = {a.x + along.center * (b.x - a.x), a.y + along.center * (b.y - a.y)};
    if (meet_.neighbors[v] < 0) return;
    edges_.coupling[v] = along.mean * polygons_.edge_lengths[v] / (2 * distance(i, v));
  }

  /// Returns the distance from the site of cell i to the one on the other side of edge v, or to its image.
  [[nodiscard]] double distance(std::size_t i, std::uint64_t v) const {
    const auto j = static_cast<std::size_t>(meet_.neighbors[v]);
    Point way{places_.x[j] - places_.x[i], places_.y[j] - places_.y[i]};
    if (!meet_.shifts.empty()) {
      way.x += meet_.shifts[v][0] * width_;
      way.y += meet_.shifts[v][1] * height_;
    }
    return lengthOf(way);
  }

  const CellPolygons& polygons_;
  const CellsThatMeet& meet_;
  const Sites& places_;
  double width_, height_;  ///< of the domain
  std::optional<DensityPixels> pixels_;
  EdgesOfCells& edges_;
};

}  // namespace

EdgesOfCells edgesOf(const CellPolygons& polygons, const CellsThatMeet& meet, const PolygonScene& scene) {
  EdgesOfCells edges;
  edges.coupling.resize(meet.neighbors.size());
  edges.middle.resize(meet.neighbors.size());
  const PolygonEdges writer(polygons, meet, scene, edges);
  const std::size_t cells = meet.offsets.size() - 1;
  parallelFor(cells, grainFor(cells, polygon_edges_grain), scene.threads,
              [&](std::size_t begin, std::size_t end) {
                for (auto i = begin; i < end; ++i) writer.cell(i);
              });
  return edges;
}

}  // namespace vorpipe::core
