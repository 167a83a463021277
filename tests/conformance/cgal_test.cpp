/// The cells of every backend against exact arithmetic.
///
/// CGAL's exact kernel gives the Delaunay neighbors; each cell is the domain cut by their bisectors,
/// in the same exact numbers. Real sites are read from the folder VORPIPE_TEST_DATA, if it is set.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "io/sites_file.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;

constexpr Box unit{0, 0, 1, 1};

/// {p : a p.x + b p.y <= c}, p relative to the cell's site.
struct HalfPlane {
  Number a, b, c;
  std::int64_t neighbor;
};

/// Where the border of a cell turns, and the half-plane whose border begins there.
struct Turn {
  Number x, y;
  std::size_t plane;
};

/// An exact cell, in double once it is known.
struct ExactCell {
  double area = 0;
  std::map<std::int64_t, double> edges;  ///< length by neighbor
};

Turn meet(const std::vector<HalfPlane>& planes, std::size_t before, std::size_t after) {
  const auto& p = planes[before];
  const auto& q = planes[after];
  const Number det = p.a * q.b - p.b * q.a;
  return {(p.c * q.b - p.b * q.c) / det, (p.a * q.c - p.c * q.a) / det, after};
}

/// Cuts a polygon by the last of the planes. Vertices follow from two planes each, never from others.
void cut(std::vector<Turn>& polygon, const std::vector<HalfPlane>& planes) {
  const auto& plane = planes.back();
  std::vector<CGAL::Sign> side;
  for (const auto& t : polygon) side.push_back(CGAL::sign(plane.a * t.x + plane.b * t.y - plane.c));
  std::vector<Turn> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto next = (k + 1) % polygon.size();
    if (side[k] == CGAL::NEGATIVE || (side[k] == CGAL::ZERO && side[next] == CGAL::NEGATIVE)) {
      kept.push_back(polygon[k]);
    } else if (side[k] == CGAL::ZERO) {
      kept.push_back({polygon[k].x, polygon[k].y, planes.size() - 1});
    }
    if (side[k] == CGAL::NEGATIVE && side[next] == CGAL::POSITIVE)
      kept.push_back(meet(planes, polygon[k].plane, planes.size() - 1));
    if (side[k] == CGAL::POSITIVE && side[next] == CGAL::NEGATIVE) {
      auto entered = meet(planes, planes.size() - 1, polygon[k].plane);
      kept.push_back(std::move(entered));
    }
  }
  polygon = std::move(kept);
}

ExactCell exactCell(const Sites& sites, const Box& domain, std::uint32_t i,
                    const std::vector<std::uint32_t>& neighbors) {
  const Number x(sites.x[i]);
  const Number y(sites.y[i]);
  std::vector<HalfPlane> planes{{0, -1, y - domain.ymin, wall_ymin},
                                {1, 0, domain.xmax - x, wall_xmax},
                                {0, 1, domain.ymax - y, wall_ymax},
                                {-1, 0, x - domain.xmin, wall_xmin}};
  std::vector<Turn> polygon;
  for (std::size_t k = 0; k < 4; ++k) polygon.push_back(meet(planes, (k + 3) % 4, k));
  for (const auto j : neighbors) {
    const Number dx = sites.x[j] - x;
    const Number dy = sites.y[j] - y;
    planes.push_back({dx, dy, (dx * dx + dy * dy) / 2, j});
    cut(polygon, planes);
  }
  ExactCell cell;
  if (polygon.size() < 3) return cell;
  Number twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto& a = polygon[k];
    const auto& b = polygon[(k + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
    const Number dx = b.x - a.x;
    const Number dy = b.y - a.y;
    cell.edges[planes[a.plane].neighbor] += std::sqrt(CGAL::to_double(dx * dx + dy * dy));
  }
  cell.area = CGAL::to_double(twice) / 2;
  return cell;
}

std::vector<ExactCell> exactCells(const Sites& sites, const Box& domain) {
  std::map<std::pair<double, double>, std::uint32_t> owners;
  for (std::uint32_t i = 0; i < sites.size(); ++i) owners.try_emplace({sites.x[i], sites.y[i]}, i);
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> points;
  for (const auto& [at, i] : owners) points.emplace_back(Kernel::Point_2(at.first, at.second), i);
  const Delaunay delaunay(points.begin(), points.end());
  std::vector<std::vector<std::uint32_t>> neighbors(sites.size());
  for (auto edge = delaunay.finite_edges_begin(); edge != delaunay.finite_edges_end(); ++edge) {
    const auto a = edge->first->vertex(Delaunay::cw(edge->second))->info();
    const auto b = edge->first->vertex(Delaunay::ccw(edge->second))->info();
    neighbors[a].push_back(b);
    neighbors[b].push_back(a);
  }
  std::vector<ExactCell> cells(sites.size());
  for (const auto& [at, i] : owners) cells[i] = exactCell(sites, domain, i, neighbors[i]);
  return cells;
}

/// Compares one cell: an edge is reported when it is longer than a millionth of the distance between
/// its two sites, and its area is within 1e-5 of itself and 1e-9 of the mean cell.
void expectCell(const Diagram& diagram, std::size_t i, const ExactCell& exact, const Sites& sites,
                const Box& domain) {
  const double width = domain.xmax - domain.xmin;
  const double height = domain.ymax - domain.ymin;
  const double mean = width * height / static_cast<double>(sites.size());
  EXPECT_NEAR(diagram.area[i], exact.area, 1e-5 * exact.area + 1e-9 * mean);
  std::map<std::int64_t, double> reported;
  for (auto e = diagram.cell_offsets[i]; e < diagram.cell_offsets[i + 1]; ++e)
    reported[diagram.neighbors[e]] = diagram.edge_lengths[e];
  const auto shortest = [&](std::int64_t neighbor) {
    if (neighbor < 0) return 1e-9 * std::max(width, height);
    const auto j = static_cast<std::size_t>(neighbor);
    return 1e-6 * std::hypot(sites.x[j] - sites.x[i], sites.y[j] - sites.y[i]);
  };
  for (const auto& [neighbor, length] : exact.edges) {
    if (length <= shortest(neighbor) * (1 + 1e-3)) continue;
    EXPECT_TRUE(reported.contains(neighbor)) << "lacks " << neighbor << ", edge " << length;
  }
  for (const auto& [neighbor, length] : reported) {
    const auto found = exact.edges.find(neighbor);
    const double expected = found == exact.edges.end() ? 0 : found->second;
    const double least = neighbor < 0 ? 0 : shortest(neighbor) * (1 - 1e-3);
    EXPECT_GT(expected, least) << "reports " << neighbor;
    EXPECT_NEAR(length, expected, 1e-4 * expected + 1e-6 * std::sqrt(mean)) << "edge to " << neighbor;
  }
}

void expectExact(const Sites& sites, const Box& domain) {
  const auto exact = exactCells(sites, domain);
  for (const char* name : {"cpu", "vulkan-geometry", "opengl"}) {
    SCOPED_TRACE(name);
    BackendOptions options;
    options.name = name;
    auto session = Session::open(options);
    ASSERT_TRUE(session) << session.error().message;
    const auto diagram = session->cells(sites, {domain, {}, {}});
    ASSERT_TRUE(diagram) << diagram.error().message;
    for (std::size_t i = 0; i < sites.size() && !testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE(testing::Message() << "site " << i);
      expectCell(*diagram, i, exact[i], sites, domain);
    }
  }
}

class AgainstCgal : public testing::Test {
 protected:
  static void SetUpTestSuite() { Number::set_relative_precision_of_to_double(1e-12); }
};

TEST_F(AgainstCgal, randomSites) {
  for (const std::uint64_t n : {1u, 2u, 3u, 10u, 2000u}) expectExact(generate(Pattern::random, n, 5), unit);
  expectExact(generate(Pattern::random, 500, 6), {0.4, -0.2, 0.7, 0.3});
}

TEST_F(AgainstCgal, lattices) {
  expectExact(generate(Pattern::square, 900, 1), unit);
  expectExact(generate(Pattern::hex, 900, 1), unit);
  auto turned = generate(Pattern::square, 900, 1);
  for (std::size_t i = 0; i < turned.size(); ++i) {
    const double x = turned.x[i];
    turned.x[i] = 0.8 * x - 0.6 * turned.y[i];
    turned.y[i] = 0.6 * x + 0.8 * turned.y[i];
  }
  expectExact(turned, {-0.3, 0.2, 0.5, 1.1});
}

TEST_F(AgainstCgal, clusters) {
  auto sites = generate(Pattern::clusters, 1500, 2);
  expectExact(sites, unit);
  const auto dust = generate(Pattern::random, 500, 3);
  for (std::size_t i = 0; i < dust.size(); ++i) {
    sites.x.push_back(0.3 + 1e-9 * dust.x[i]);
    sites.y.push_back(0.6 + 1e-9 * dust.y[i]);
  }
  expectExact(sites, unit);
}

TEST_F(AgainstCgal, cocircularSites) {
  auto sites = generate(Pattern::circle, 500, 1);
  expectExact(sites, unit);
  sites.x.push_back(0.5);
  sites.y.push_back(0.5);
  expectExact(sites, unit);
}

TEST_F(AgainstCgal, nearlyCollinearSites) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> along(0, 1);
  for (const double noise : {0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
    SCOPED_TRACE(noise);
    Sites sites;
    for (int i = 0; i < 300; ++i) {
      sites.x.push_back(along(random));
      sites.y.push_back(0.1 + 0.75 * sites.x.back() + noise * along(random));
    }
    expectExact(sites, unit);
  }
}

TEST_F(AgainstCgal, sitesATrillionthOfTheDomainApart) {
  auto sites = generate(Pattern::random, 300, 9);
  for (std::size_t i = 0; i < 60; ++i) {
    const double angle = static_cast<double>(i);
    sites.x.push_back(sites.x[i] + 2e-12 * std::cos(angle));
    sites.y.push_back(sites.y[i] + 2e-12 * std::sin(angle));
  }
  expectExact(sites, unit);
}

TEST_F(AgainstCgal, realSites) {
  const char* folder = std::getenv("VORPIPE_TEST_DATA");
  if (!folder) GTEST_SKIP() << "VORPIPE_TEST_DATA names no folder of real sites";
  // Not those with sites nearer to each other than 1e-13 of the domain, and not the largest.
  std::vector<std::string> names{"navaids", "us_cities", "jcv_issue91", "delaunator_robustness4"};
  for (int i = 1; i <= 11; ++i) names.push_back("voronoice_degenerated" + std::to_string(i));
  for (const auto& name : names) {
    SCOPED_TRACE(name);
    const auto sites = readSites((std::filesystem::path(folder) / (name + ".csv")).string());
    ASSERT_TRUE(sites) << sites.error().message;
    const auto [left, right] = std::minmax_element(sites->x.begin(), sites->x.end());
    const auto [bottom, top] = std::minmax_element(sites->y.begin(), sites->y.end());
    const double margin = 0.05 * std::max(*right - *left, *top - *bottom);
    expectExact(*sites, {*left - margin, *bottom - margin, *right + margin, *top + margin});
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace vorpipe::test
