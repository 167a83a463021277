#include "support/exact/exact_neighbors.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <utility>

#include "support/exact/exact_bisector.h"

namespace vorpipe::test {
namespace {

// Predicates on doubles need no exact points; figures that follow from them do need exact numbers.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
template <class Base>
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel, Base>;
using Delaunay = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<Vertex<CGAL::Triangulation_vertex_base_2<Kernel>>>>;
using Regular = CGAL::Regular_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<Vertex<CGAL::Regular_triangulation_vertex_base_2<Kernel>>,
                                                 CGAL::Regular_triangulation_face_base_2<Kernel>>>;

/// Triangulates the sites that take part; makePoint(i) is the point of site i.
template <class Triangulation, class MakePoint>
ExactNeighbors triangulated(const std::vector<std::uint8_t>& takes_part, const MakePoint& makePoint) {
  std::vector<std::pair<decltype(makePoint(0)), std::uint32_t>> points;
  for (std::uint32_t i = 0; i < takes_part.size(); ++i) {
    if (takes_part[i] != 0) points.emplace_back(makePoint(i), i);
  }
  Triangulation all;
  all.insert(points.begin(), points.end());
  const bool has_triangles = all.dimension() == 2;
  ExactNeighbors neighbors{std::vector<std::vector<Spoke>>(takes_part.size()), takes_part,
                           has_triangles ? all.number_of_faces() : 0};
  for (auto vertex = all.finite_vertices_begin(); vertex != all.finite_vertices_end(); ++vertex)
    neighbors.hidden[vertex->info()] = 0;
  const auto third = [&](const auto& vertex) { return all.is_infinite(vertex) ? no_site : vertex->info(); };
  for (auto edge = all.finite_edges_begin(); edge != all.finite_edges_end(); ++edge) {
    const auto& [face, opposite] = *edge;
    const auto a = face->vertex(Triangulation::ccw(opposite))->info();
    const auto b = face->vertex(Triangulation::cw(opposite))->info();
    const auto left = has_triangles ? third(face->vertex(opposite)) : no_site;
    const auto right = has_triangles ? third(all.mirror_vertex(face, opposite)) : no_site;
    neighbors.of[a].push_back({b, left, right});
    neighbors.of[b].push_back({a, right, left});
  }
  return neighbors;
}

/// Whether the cell of a site that is in the triangulation is a point, or a part of a line.
bool hasNoArea(const ExactPlaces& places, std::uint32_t site, const std::vector<Spoke>& spokes) {
  std::vector<Bisector> long_ones;
  for (const auto& spoke : spokes) {
    const auto bisector = places.bisector(site, spoke.to);
    if (spoke.left == no_site || spoke.right == no_site ||
        places.meeting(site, bisector, spoke.left) != places.meeting(site, bisector, spoke.right))
      long_ones.push_back(bisector);
  }
  if (long_ones.size() != 2) return long_ones.empty() && !spokes.empty();
  const auto& [a, b] = std::pair(long_ones[0], long_ones[1]);
  return cross(a.way, b.way) == 0 && a.reach * a.way.x == b.reach * b.way.x &&
         a.reach * a.way.y == b.reach * b.way.y;
}

}  // namespace

ExactNeighbors exactNeighbors(const Sites& sites, const std::vector<std::uint32_t>& owner) {
  std::vector<std::uint8_t> takes_part(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) takes_part[i] = owner[i] == i ? 1 : 0;
  const auto place = [&](std::uint32_t i) { return Kernel::Point_2(sites.x[i], sites.y[i]); };
  if (sites.weight.empty()) return triangulated<Delaunay>(takes_part, place);

  const auto weighted = [&](std::uint32_t i) { return Kernel::Weighted_point_2(place(i), sites.weight[i]); };
  auto neighbors = triangulated<Regular>(takes_part, weighted);
  // Whether a site on the verge of being hidden is in the triangulation is CGAL's choice. Without it, the
  // cells of the others are the same.
  const ExactPlaces places(sites);
  auto hidden = neighbors.hidden;
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (takes_part[i] == 0 || hidden[i] != 0 || !hasNoArea(places, i, neighbors.of[i])) continue;
    hidden[i] = 1;
    takes_part[i] = 0;
  }
  if (hidden == neighbors.hidden) return neighbors;
  neighbors = triangulated<Regular>(takes_part, weighted);
  neighbors.hidden = std::move(hidden);
  return neighbors;
}

}  // namespace vorpipe::test
