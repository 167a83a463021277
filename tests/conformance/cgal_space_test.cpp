/// Cells in space against Delaunay and regular triangulations by CGAL, with exact predicates.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "unit/fixtures/cpu_session.h"

namespace vorpipe::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
/// Of the sphere around a tetrahedron.
struct Center {
  Point3 place;
  bool inside;  ///< whether it is in the cube, exactly
};
using Triangulation = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<
                CGAL::Triangulation_vertex_base_with_info_3<std::int64_t, Kernel>,
                CGAL::Triangulation_cell_base_with_info_3<Center, Kernel,
                                                          CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>>;
/// Of weighted points; those that others hide are no vertices of it.
using Regular = CGAL::Regular_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<
                CGAL::Triangulation_vertex_base_with_info_3<
                    std::int64_t, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>,
                CGAL::Triangulation_cell_base_with_info_3<Center, Kernel,
                                                          CGAL::Regular_triangulation_cell_base_3<Kernel>>>>;
using Labels = std::vector<std::int64_t>;

constexpr Box3 cube{0, 0, 0, 1, 1, 1};
constexpr std::uint64_t seed = 20261204;

/// A generator's sites, each moved by up to so much of their mean distance.
struct Scene {
  std::string name;
  Pattern3 pattern;
  std::uint64_t count;
  double noise;
};

Sites3 sitesOf(const Scene& scene) {
  Sites3 sites = generate(scene.pattern, scene.count, seed);
  const double reach = scene.noise / std::cbrt(static_cast<double>(sites.size()));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-reach, reach);
  for (Point3& p : sites) p = {p.x + uniform(random), p.y + uniform(random), p.z + uniform(random)};
  return sites;
}

/// Cells carry their centers; those that are not finite are not inside.
Triangulation triangulated(const Sites3& sites) {
  std::vector<std::pair<Kernel::Point_3, std::int64_t>> points;
  for (std::size_t i = 0; i < sites.size(); ++i)
    points.emplace_back(Kernel::Point_3(sites[i].x, sites[i].y, sites[i].z), static_cast<std::int64_t>(i));
  Triangulation triangulation(points.begin(), points.end());
  for (const auto cell : triangulation.finite_cell_handles()) {
    const auto exactly = [cell](int k) {
      const auto& p = cell->vertex(k)->point();
      return Exact::Point_3(p.x(), p.y(), p.z());
    };
    const auto c = CGAL::circumcenter(exactly(0), exactly(1), exactly(2), exactly(3));
    cell->info() = {{CGAL::to_double(c.x()), CGAL::to_double(c.y()), CGAL::to_double(c.z())},
                    c.x() >= 0 && c.x() <= 1 && c.y() >= 0 && c.y() <= 1 && c.z() >= 0 && c.z() <= 1};
  }
  return triangulation;
}

Regular triangulated(const Sites3& sites, const std::vector<double>& weights) {
  std::vector<std::pair<Kernel::Weighted_point_3, std::int64_t>> points;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    points.emplace_back(
        Kernel::Weighted_point_3(Kernel::Point_3(sites[i].x, sites[i].y, sites[i].z), weights[i]),
        static_cast<std::int64_t>(i));
  }
  Regular triangulation(points.begin(), points.end());
  for (const auto cell : triangulation.finite_cell_handles()) {
    const auto exactly = [cell](int k) {
      const auto& p = cell->vertex(k)->point();
      return Exact::Weighted_point_3(Exact::Point_3(p.x(), p.y(), p.z()), p.weight());
    };
    const auto c = CGAL::weighted_circumcenter(exactly(0), exactly(1), exactly(2), exactly(3));
    cell->info() = {{CGAL::to_double(c.x()), CGAL::to_double(c.y()), CGAL::to_double(c.z())},
                    c.x() >= 0 && c.x() <= 1 && c.y() >= 0 && c.y() <= 1 && c.z() >= 0 && c.z() <= 1};
  }
  return triangulation;
}

template <class Cell>
Labels labelsOf(Cell cell) {
  Labels labels;
  for (int k = 0; k < 4; ++k) labels.push_back(cell->vertex(k)->info());
  std::ranges::sort(labels);
  return labels;
}

/// The vertices of a diagram: each tetrahedron by its sites, and those of what is joined, by each of its
/// sites.
struct Vertices {
  std::set<Labels> tetrahedra;
  std::map<std::int64_t, std::vector<Labels>> joined;
};

Vertices verticesOf(const Diagram3& diagram) {
  Vertices vertices;
  for (std::size_t v = 0; v < diagram.vertices.size(); ++v) {
    const auto begin = diagram.vertex_sites.begin();
    Labels labels(begin + static_cast<std::ptrdiff_t>(diagram.vertex_site_offsets[v]),
                  begin + static_cast<std::ptrdiff_t>(diagram.vertex_site_offsets[v + 1]));
    const bool at_wall = isWall(labels.front());
    std::erase_if(labels, isWall);
    if (labels.size() == 4 && !at_wall) {
      vertices.tetrahedra.insert(labels);
    } else if (labels.size() >= 4) {
      for (const auto site : labels) vertices.joined[site].push_back(labels);
    }
  }
  return vertices;
}

using Pair = std::pair<std::int64_t, std::int64_t>;

/// The area of the polygon around an edge.
double areaOf(const std::vector<Point3>& ring) {
  Point3 sum{};
  const Point3& o = ring[0];
  for (std::size_t k = 2; k < ring.size(); ++k) {
    const Point3 a{ring[k - 1].x - o.x, ring[k - 1].y - o.y, ring[k - 1].z - o.z};
    const Point3 b{ring[k].x - o.x, ring[k].y - o.y, ring[k].z - o.z};
    sum = {sum.x + a.y * b.z - a.z * b.y, sum.y + a.z * b.x - a.x * b.z, sum.z + a.x * b.y - a.y * b.x};
  }
  return std::hypot(sum.x, sum.y, sum.z) / 2;
}

/// The areas of what two sites have in common, where all of it is inside the cube; else -1.
template <class Mesh>
std::map<Pair, double> areasOf(const Mesh& triangulation) {
  std::map<Pair, double> areas;
  for (const auto& edge : triangulation.finite_edges()) {
    std::vector<Point3> ring;
    bool inside = true;
    auto at = triangulation.incident_cells(edge);
    const auto first = at;
    do {
      inside = inside && !triangulation.is_infinite(at) && at->info().inside;
      ring.push_back(at->info().place);
    } while (++at != first);
    const auto i = edge.first->vertex(edge.second)->info(), j = edge.first->vertex(edge.third)->info();
    areas[{std::min(i, j), std::max(i, j)}] = inside ? areaOf(ring) : -1;
  }
  return areas;
}

/// Every tetrahedron whose center is in the cube is a vertex of the cells, or part of one where ties are
/// joined; and every vertex of four sites is one of the tetrahedra.
template <class Mesh>
void expectTetrahedra(const Mesh& triangulation, const Diagram3& diagram) {
  const Vertices vertices = verticesOf(diagram);
  std::set<Labels> unseen = vertices.tetrahedra;
  std::size_t inside = 0;
  for (const auto cell : triangulation.finite_cell_handles()) {
    if (!cell->info().inside) continue;
    ++inside;
    const Labels labels = labelsOf(cell);
    if (unseen.erase(labels) > 0) continue;
    const auto around = vertices.joined.find(labels[0]);
    const bool is_part =
        around != vertices.joined.end() && std::ranges::any_of(around->second, [&](const Labels& all) {
          return std::ranges::includes(all, labels);
        });
    EXPECT_TRUE(is_part) << labels[0] << ' ' << labels[1] << ' ' << labels[2] << ' ' << labels[3];
  }
  EXPECT_GT(inside, diagram.report.ok / 2);
  EXPECT_EQ(unseen, std::set<Labels>());
}

/// Faces have the areas that CGAL's tetrahedra say; one that has no more than ties leave may be missing.
template <class Mesh>
void expectFaces(const Mesh& triangulation, const Diagram3& diagram, bool of_sphere, double ties = 2e-6) {
  auto areas = areasOf(triangulation);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    const double slack = ties * diagram.surface[i];
    for (auto f = diagram.face_offsets[i]; f < diagram.face_offsets[i + 1]; ++f) {
      const auto site = static_cast<std::int64_t>(i), neighbor = diagram.neighbors[f];
      if (isWall(neighbor) || neighbor < site) continue;
      const auto found = areas.find({site, neighbor});
      const double area = found == areas.end() ? 0 : found->second;
      if (area >= 0) {
        EXPECT_NEAR(diagram.face_areas[f], area, slack) << i << " and " << neighbor;
      }
      if (found == areas.end()) continue;
      inside += area > slack ? 1 : 0;
      areas.erase(found);
    }
  }
  // All cells of a sphere's sites reach from its center to walls.
  if (!of_sphere) {
    EXPECT_GT(inside, diagram.report.ok);
  }
  for (const auto& [pair, area] : areas) {
    EXPECT_LE(area, ties * diagram.surface[static_cast<std::size_t>(pair.first)])
        << pair.first << " and " << pair.second << " are no neighbors";
  }
}

class AgainstCgal : public testing::TestWithParam<Scene> {};

TEST_P(AgainstCgal, CellsInSpaceAgree) {
  const Sites3 sites = sitesOf(GetParam());
  SCOPED_TRACE(testing::Message() << sites.size() << " sites, seed " << seed);
  auto session = cpuSession();
  const auto diagram = session.cells(std::span<const Point3>(sites), {cube, Detail3::polyhedra, {}});
  ASSERT_TRUE(diagram) << diagram.error().message;
  const Triangulation triangulation = triangulated(sites);
  expectTetrahedra(triangulation, *diagram);
  expectFaces(triangulation, *diagram, GetParam().pattern == Pattern3::sphere);
}

INSTANTIATE_TEST_SUITE_P(
    , AgainstCgal,
    testing::Values(Scene{"random", Pattern3::random, 2000, 0}, Scene{"jitter", Pattern3::jitter, 1728, 0},
                    Scene{"clusters", Pattern3::clusters, 2000, 0}, Scene{"sphere", Pattern3::sphere, 300, 0},
                    Scene{"cubic", Pattern3::cubic, 1000, 0}, Scene{"fcc", Pattern3::fcc, 1372, 0},
                    Scene{"hcp", Pattern3::hcp, 1000, 0}, Scene{"bcc_1e_9", Pattern3::bcc, 1024, 1e-9},
                    Scene{"cubic_1e_7", Pattern3::cubic, 1000, 1e-7},
                    Scene{"hcp_1e_6", Pattern3::hcp, 1000, 1e-6},
                    Scene{"fcc_1e_5", Pattern3::fcc, 1372, 1e-5},
                    Scene{"diamond_1e_4", Pattern3::diamond, 1000, 1e-4},
                    Scene{"a15_1e_3", Pattern3::a15, 1000, 1e-3}),
    [](const auto& instance) { return instance.param.name; });

/// The same with weights of up to so many squares of the sites' mean distance: in so many steps, or any.
struct Weighed {
  Scene scene;
  double most;
  int steps = 0;
};

class AgainstCgalWithWeights : public testing::TestWithParam<Weighed> {};

TEST_P(AgainstCgalWithWeights, CellsInSpaceAgree) {
  const auto& [scene, most, steps] = GetParam();
  const Sites3 sites = sitesOf(scene);
  SCOPED_TRACE(testing::Message() << sites.size() << " sites, seed " << seed);
  const double square = std::pow(static_cast<double>(sites.size()), -2.0 / 3);
  std::mt19937_64 random(seed + 1);
  std::vector<double> weights;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double u = static_cast<double>(random() >> 11) * 0x1p-53;
    weights.push_back(most * square * (steps > 0 ? std::floor(u * (steps + 1)) / steps : u));
  }
  auto session = cpuSession();
  const auto diagram = session.cells(std::span<const Point3>(sites), {cube, Detail3::polyhedra, {}, weights});
  ASSERT_TRUE(diagram) << diagram.error().message;
  const Regular triangulation = triangulated(sites, weights);
  expectTetrahedra(triangulation, *diagram);
  // Ties are measured by the distances of sites, which may be larger than cells.
  expectFaces(triangulation, *diagram, false, 2e-5);
  std::vector<bool> is_vertex(sites.size());
  for (const auto vertex : triangulation.finite_vertex_handles())
    is_vertex[static_cast<std::size_t>(vertex->info())] = true;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!is_vertex[i]) {
      EXPECT_NE(diagram->status[i], Status::ok) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, AgainstCgalWithWeights,
                         testing::Values(Weighed{{"random", Pattern3::random, 2000, 0}, 0.5},
                                         Weighed{{"heavy", Pattern3::random, 2000, 0}, 4},
                                         Weighed{{"clusters", Pattern3::clusters, 2000, 0}, 0.2},
                                         Weighed{{"two_kinds", Pattern3::random, 2000, 0}, 2, 1},
                                         Weighed{{"cubic", Pattern3::cubic, 1000, 0}, 0.5, 2},
                                         Weighed{{"fcc", Pattern3::fcc, 1372, 0}, 0.25, 3},
                                         Weighed{{"bcc_1e_9", Pattern3::bcc, 1024, 1e-9}, 0.25, 2},
                                         Weighed{{"hcp_1e_6", Pattern3::hcp, 1000, 1e-6}, 0.2, 1},
                                         Weighed{{"fcc_1e_5", Pattern3::fcc, 1372, 1e-5}, 0.1, 1},
                                         Weighed{{"diamond_1e_4", Pattern3::diamond, 1000, 1e-4}, 0.1}),
                         [](const auto& instance) { return instance.param.scene.name; });

}  // namespace
}  // namespace vorpipe::test
