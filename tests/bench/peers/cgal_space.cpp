#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>
#include <tbb/global_control.h>

#include "bench/peers/space_peer.h"

namespace vorpipe::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using OnOneThread = CGAL::Delaunay_triangulation_3<Kernel>;
using OnThreads = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_3<Kernel>,
                                                 CGAL::Delaunay_triangulation_cell_base_3<Kernel>,
                                                 CGAL::Parallel_tag>>;
constexpr int locks = 50;  // along each axis, as its examples have it

template <class Triangulation>
std::size_t inside(const Triangulation& triangulation, double side) {
  std::size_t count = 0;
  for (const auto cell : triangulation.finite_cell_handles()) {
    const auto center = triangulation.dual(cell);
    const auto within = [side](double x) { return x >= 0 && x <= side; };
    if (within(center.x()) && within(center.y()) && within(center.z())) ++count;
  }
  return count;
}

Result<TriangulatedInSpace> triangulate(const SpaceInput& input, int threads) {
  std::vector<Kernel::Point_3> points;
  points.reserve(input.sites.size());
  for (const Point3& p : input.sites) points.emplace_back(p.x, p.y, p.z);
  if (threads == 1) {
    const JobWatch watch;
    const OnOneThread triangulation(points.begin(), points.end());
    const Taken taken = watch.taken();
    return TriangulatedInSpace{taken, inside(triangulation, input.side)};
  }
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  const JobWatch watch;
  OnThreads::Lock_data_structure grid(CGAL::Bbox_3(0, 0, 0, input.side, input.side, input.side), locks);
  const OnThreads triangulation(points.begin(), points.end(), &grid);
  const Taken taken = watch.taken();
  return TriangulatedInSpace{taken, inside(triangulation, input.side)};
}

}  // namespace

SpacePeer cgalInSpace() {
  return {"cgal", "CGAL Delaunay_triangulation_3", CGAL_VERSION_STR, true, triangulate, {}};
}

}  // namespace vorpipe::test
