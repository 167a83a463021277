#include <boost/polygon/point_data.hpp>
#include <boost/polygon/voronoi_builder.hpp>
#include <boost/polygon/voronoi_diagram.hpp>
#include <boost/version.hpp>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/peers/peer.h"

namespace vorpipe::test {
namespace {

using Points = std::vector<boost::polygon::point_data<std::int32_t>>;
using Voronoi = boost::polygon::voronoi_diagram<double>;

/// The grid's own integers: the largest that the algorithm is proved for.
Result<Points> integers(const BenchInput& input) {
  Points points;
  points.reserve(input.sites.size());
  for (std::size_t i = 0; i < input.sites.size(); ++i) {
    const double x = input.sites.x[i] / input.grid, y = input.sites.y[i] / input.grid;
    constexpr double most = std::numeric_limits<std::int32_t>::max();
    if (std::abs(x) > most || std::abs(y) > most)
      return tl::unexpected(
          Error{ErrorCode::input, "a site is too far from the domain for Boost's integers"});
    points.emplace_back(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y));
  }
  return points;
}

void build(const Points& points, Voronoi& diagram) {
  boost::polygon::voronoi_builder<std::int32_t> builder;
  for (const auto& point : points) builder.insert_point(point.x(), point.y());
  builder.construct(&diagram);
}

/// The dual's, a vertex of the diagram where k edges meet being k - 2.
std::size_t trianglesOf(const Voronoi& diagram) {
  std::size_t triangles = 0;
  for (const auto& vertex : diagram.vertices()) {
    const auto* edge = vertex.incident_edge();
    std::size_t edges = 0;
    do {
      ++edges;
      edge = edge->rot_next();
    } while (edge != vertex.incident_edge());
    triangles += edges - 2;
  }
  return triangles;
}

Result<Triangulated> triangulate(const BenchInput& input) {
  const auto points = integers(input);
  if (!points) return tl::unexpected(points.error());
  const JobWatch watch;
  Voronoi diagram;
  build(*points, diagram);
  const Taken taken = watch.taken();
  return Triangulated{taken, trianglesOf(diagram)};
}

Result<FullyMeasured> measure(const BenchInput& input) {
  const auto points = integers(input);
  if (!points) return tl::unexpected(points.error());
  const JobWatch watch;
  Voronoi diagram;
  build(*points, diagram);
  PeerCells cells(input);
  std::vector<Point> vertices;
  std::vector<std::int32_t> neighbors;
  for (const auto& cell : diagram.cells()) {
    vertices.clear();
    neighbors.clear();
    bool inside = true;
    const auto* edge = cell.incident_edge();
    if (edge == nullptr) return tl::unexpected(Error{ErrorCode::input, "a single site has no edges"});
    do {
      neighbors.push_back(static_cast<std::int32_t>(edge->twin()->cell()->source_index()));
      if (const auto* vertex = edge->vertex0()) {
        vertices.push_back({vertex->x() * input.grid, vertex->y() * input.grid});
        inside = inside && contains(input.domain, vertices.back());
      } else {
        inside = false;
      }
      edge = edge->next();
    } while (edge != cell.incident_edge());
    const auto site = static_cast<std::uint32_t>(cell.source_index());
    if (inside) {
      cells.add(site, vertices, neighbors);
    } else {
      cells.addCut(site, neighbors);
    }
  }
  return FullyMeasured{watch.taken(), std::move(cells)};
}

}  // namespace

Peer boostVoronoi() {
  const std::string version =
      fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100);
  return {"boost", "Boost.Polygon voronoi", version, true, false, triangulate, measure};
}

}  // namespace vorpipe::test
