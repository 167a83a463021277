#include "bench/cgal_delaunay.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <vector>

namespace vorpipe::test {

Triangulated triangulate(const Sites& sites) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> points;
  points.reserve(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) points.emplace_back(sites.x[i], sites.y[i]);
  const auto begin = std::chrono::steady_clock::now();
  CGAL::Delaunay_triangulation_2<Kernel> triangulation;
  triangulation.insert(points.begin(), points.end());
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  return {triangulation.number_of_faces(), taken.count()};
}

}  // namespace vorpipe::test
