#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_face_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_2.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/version.h>

#include <utility>
#include <vector>

#include "bench/peers/peer.h"

namespace vorpipe::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Plain = CGAL::Delaunay_triangulation_2<Kernel>;
using PlainWeighted = CGAL::Regular_triangulation_2<Kernel>;

// For cells, vertices carry their site's index, and faces their (weighted) circumcenter, so that it is
// computed once and not for each of its three cells.
template <class VertexBase, class FaceBase>
using Structure = CGAL::Triangulation_data_structure_2<
    CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel, VertexBase>,
    CGAL::Triangulation_face_base_with_info_2<Point, Kernel, FaceBase>>;

class Delaunay
    : public CGAL::Delaunay_triangulation_2<Kernel, Structure<CGAL::Triangulation_vertex_base_2<Kernel>,
                                                              CGAL::Triangulation_face_base_2<Kernel>>> {
 public:
  [[nodiscard]] auto center(Face_handle face) const { return circumcenter(face); }
};

class Regular
    : public CGAL::Regular_triangulation_2<Kernel,
                                           Structure<CGAL::Regular_triangulation_vertex_base_2<Kernel>,
                                                     CGAL::Regular_triangulation_face_base_2<Kernel>>> {
 public:
  [[nodiscard]] auto center(Face_handle face) const { return weighted_circumcenter(face); }
};

template <class Triangulation>
auto pointOf(const Sites& sites, Kernel::Point_2 place, std::size_t site) {
  if constexpr (std::is_same_v<typename Triangulation::Point, Kernel::Point_2>) {
    return place;
  } else {
    return typename Triangulation::Point(place, sites.weight.empty() ? 0 : sites.weight[site]);
  }
}

template <class Triangulation>
Result<Triangulated> triangulate(const BenchInput& input) {
  std::vector<typename Triangulation::Point> points;
  points.reserve(input.sites.size());
  for (std::size_t i = 0; i < input.sites.size(); ++i)
    points.push_back(pointOf<Triangulation>(input.sites, {input.sites.x[i], input.sites.y[i]}, i));
  const JobWatch watch;
  Triangulation triangulation;
  triangulation.insert(points.begin(), points.end());
  return Triangulated{watch.taken(), triangulation.number_of_faces()};
}

using Numbered = std::pair<Kernel::Point_2, std::uint32_t>;

/// As the range insertion does, but for the sort: where there is info, that sorts indices, and then fetches
/// each point from anywhere in memory.
template <class Triangulation>
void insert(const Sites& sites, std::vector<Numbered>& points, Triangulation& triangulation) {
  using Traits = CGAL::Spatial_sort_traits_adapter_2<Kernel, CGAL::First_of_pair_property_map<Numbered>>;
  CGAL::spatial_sort(points.begin(), points.end(), Traits());
  typename Triangulation::Face_handle hint;
  for (const auto& [place, site] : points) {
    const auto vertex = triangulation.insert(pointOf<Triangulation>(sites, place, site), hint);
    vertex->info() = site;
    hint = vertex->face();
  }
}

template <class Triangulation>
void addCells(const Triangulation& triangulation, const Box& domain, PeerCells& cells) {
  std::vector<Point> vertices;
  std::vector<std::int32_t> neighbors;
  for (const auto vertex : triangulation.finite_vertex_handles()) {
    vertices.clear();
    neighbors.clear();
    bool inside = true;
    auto face = triangulation.incident_faces(vertex);
    const auto first = face;
    do {
      const int index = face->index(vertex);
      const auto next = face->vertex(Triangulation::cw(index));
      if (triangulation.is_infinite(face)) {
        inside = false;
      } else {
        inside = inside && contains(domain, face->info());
        vertices.push_back(face->info());
      }
      if (!triangulation.is_infinite(next)) neighbors.push_back(static_cast<std::int32_t>(next->info()));
    } while (++face != first);
    if (inside) {
      cells.add(vertex->info(), vertices, neighbors);
    } else {
      cells.addCut(vertex->info(), neighbors);
    }
  }
}

template <class Triangulation>
Result<FullyMeasured> measure(const BenchInput& input) {
  std::vector<Numbered> points;
  points.reserve(input.sites.size());
  for (std::uint32_t i = 0; i < input.sites.size(); ++i)
    points.emplace_back(Kernel::Point_2(input.sites.x[i], input.sites.y[i]), i);
  const JobWatch watch;
  Triangulation triangulation;
  insert(input.sites, points, triangulation);
  if (triangulation.dimension() < 2)
    return tl::unexpected(Error{ErrorCode::input, "all sites lie on a line"});
  for (const auto face : triangulation.finite_face_handles()) {
    const auto center = triangulation.center(face);
    face->info() = {center.x(), center.y()};
  }
  PeerCells cells(input);
  addCells(triangulation, input.domain, cells);
  return FullyMeasured{watch.taken(), std::move(cells)};
}

}  // namespace

Peer cgalDelaunay() {
  return {
      "cgal",           "CGAL Delaunay_triangulation_2", CGAL_VERSION_STR, true, false, triangulate<Plain>,
      measure<Delaunay>};
}

Peer cgalRegular() {
  return {"cgal-regular", "CGAL Regular_triangulation_2", CGAL_VERSION_STR, false,
          true,           triangulate<PlainWeighted>,     measure<Regular>};
}

}  // namespace vorpipe::test
