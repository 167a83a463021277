// Cells in space, from sites to a diagram.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr Box3 unit_cube{0, 0, 0, 1, 1, 1};

Diagram3 cellsOf(const Sites3& sites, const Box3& domain = unit_cube, int threads = 1,
                 Detail3 detail = Detail3::polyhedra) {
  BackendOptions backend;
  backend.name = "cpu";
  backend.threads = threads;
  auto session = Session::open(backend);
  EXPECT_TRUE(session.has_value());
  Cells3Options options;
  options.domain = domain;
  options.detail = detail;
  auto diagram = session->cells(std::span<const Point3>(sites), options);
  EXPECT_TRUE(diagram.has_value()) << (diagram ? "" : diagram.error().message);
  if (!diagram) return {};
  const auto problems = check(sites, options, *diagram, threads);
  EXPECT_TRUE(problems.has_value());
  if (problems) {
    for (const std::string& problem : *problems) ADD_FAILURE() << problem;
  }
  const double volume =
      (domain.xmax - domain.xmin) * (domain.ymax - domain.ymin) * (domain.zmax - domain.zmin);
  EXPECT_NEAR(volumeSum(*diagram), volume, 1e-12 * volume);
  return std::move(*diagram);
}

std::size_t faces(const Diagram3& diagram, std::size_t site) {
  return diagram.face_offsets[site + 1] - diagram.face_offsets[site];
}

/// Whether a cell has no wall, and nor has any of its neighbors'.
std::vector<bool> inside(const Diagram3& diagram) {
  std::vector<bool> touches(diagram.size()), near(diagram.size());
  const auto eachNeighbor = [&diagram](std::size_t i, const auto& body) {
    for (std::uint64_t f = diagram.face_offsets[i]; f < diagram.face_offsets[i + 1]; ++f)
      body(diagram.neighbors[f]);
  };
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    eachNeighbor(i, [&](std::int64_t n) { touches[i] = touches[i] || isWall(n); });
  }
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    eachNeighbor(
        i, [&](std::int64_t n) { near[i] = near[i] || isWall(n) || touches[static_cast<std::size_t>(n)]; });
  }
  near.flip();
  return near;
}

Sites3 noisy(Sites3 sites, double noise, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-noise, noise);
  for (Point3& p : sites) p = {p.x + uniform(random), p.y + uniform(random), p.z + uniform(random)};
  return sites;
}

struct Lattice {
  const char* name;
  Pattern3 pattern;
  std::vector<std::size_t> faces;  ///< of cells inside
};

class Lattices : public testing::TestWithParam<std::tuple<Lattice, double>> {};

TEST_P(Lattices, HaveTheirCells) {
  const auto& [lattice, noise] = GetParam();
  const Sites3 exact = generate(lattice.pattern, 500, 1);
  const double spacing = std::cbrt(1.0 / static_cast<double>(exact.size()));
  const Sites3 sites = noisy(exact, noise * spacing, 7);
  Box3 box = unit_cube;
  const Diagram3 diagram = cellsOf(sites, box);
  const auto is_inside = inside(diagram);
  std::size_t count = 0;
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    if (!is_inside[i]) continue;
    ++count;
    EXPECT_TRUE(std::ranges::find(lattice.faces, faces(diagram, i)) != lattice.faces.end())
        << lattice.name << ": cell " << i << " has " << faces(diagram, i) << " faces";
  }
  EXPECT_GT(count, 5U);
  EXPECT_EQ(diagram.flat, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Of, Lattices,
    testing::Combine(testing::Values(Lattice{"cubic", Pattern3::cubic, {6}},
                                     Lattice{"fcc", Pattern3::fcc, {12}}, Lattice{"bcc", Pattern3::bcc, {14}},
                                     Lattice{"hcp", Pattern3::hcp, {12}},
                                     Lattice{"diamond", Pattern3::diamond, {16}},
                                     Lattice{"a15", Pattern3::a15, {12, 14}}),
                     testing::Values(0, 1e-15, 1e-12, 1e-9)),
    [](const auto& of) { return std::string(std::get<0>(of.param).name) + "_" + std::to_string(of.index); });

/// What is known of a crystal's cells with so many faces.
struct Known {
  Pattern3 pattern;
  std::size_t faces;
  double volume;         ///< where the nearest sites are 1 apart
  double surface;        ///< of a cell of volume 1; 0: it has no short name
  double second_moment;  ///< about one axis, of a cell of volume 1; 0 as well
};

TEST(SpaceCells, OfCrystalsHaveTheMeasuresOfTheory) {
  const double root2 = std::numbers::sqrt2, root3 = std::numbers::sqrt3;
  const double dense = 3 / root2 * std::cbrt(16), dense_moment = std::exp2(-11.0 / 3);
  const std::vector<Known> crystals{
      {Pattern3::cubic, 6, 1, 6, 1.0 / 12},
      {Pattern3::fcc, 12, 1 / root2, dense, dense_moment},
      {Pattern3::hcp, 12, 1 / root2, dense, dense_moment},
      {Pattern3::bcc, 14, 4 / (3 * root3), (6 + 12 * root3) / 8 * std::cbrt(4), 19 / (192 * std::cbrt(2))},
      {Pattern3::diamond, 16, 8 / (3 * root3), 3 * root3 + 3 * root2 / 4, 0},
      {Pattern3::a15, 12, 125.0 / 128, 0, 0},
      {Pattern3::a15, 14, 129.0 / 128, 0, 0}};
  for (const Known& known : crystals) {
    SCOPED_TRACE(testing::Message() << "pattern " << static_cast<int>(known.pattern) << ", " << known.faces);
    const Sites3 sites = generate(known.pattern, 700, 1);
    const Diagram3 diagram = cellsOf(sites);
    const auto is_inside = inside(diagram);
    double nearest = 1;
    for (std::size_t i = 1; i < sites.size(); ++i) {
      const Point3& a = sites[0];
      const Point3& b = sites[i];
      nearest = std::min(nearest, std::hypot(a.x - b.x, a.y - b.y, a.z - b.z));
    }
    // The first site of A15 has no neighbor as near as others have.
    if (known.pattern == Pattern3::a15) nearest *= 2 / std::sqrt(5);
    std::size_t count = 0;
    for (std::size_t i = 0; i < diagram.size(); ++i) {
      if (!is_inside[i] || faces(diagram, i) != known.faces) continue;
      ++count;
      const double volume = diagram.volume[i], side = std::cbrt(volume);
      EXPECT_NEAR(volume / std::pow(nearest, 3), known.volume, 1e-12) << i;
      if (known.surface > 0) {
        EXPECT_NEAR(diagram.surface[i] / std::pow(side, 2), known.surface, 1e-12) << i;
      }
      const auto& moments = diagram.second_moments[i];
      if (known.second_moment > 0) {
        EXPECT_NEAR((moments[0] + moments[1] + moments[2]) / 3 / std::pow(side, 5), known.second_moment,
                    1e-12);
      }
    }
    EXPECT_GT(count, 10U);
  }
}

TEST(SpaceCells, OfACubicLatticeAreCubes) {
  const Sites3 sites = generate(Pattern3::cubic, 1000, 1);
  const Diagram3 diagram = cellsOf(sites);
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    EXPECT_NEAR(diagram.volume[i], 1e-3, 1e-15);
    EXPECT_NEAR(diagram.surface[i], 6e-2, 1e-13);
    EXPECT_NEAR(diagram.second_moments[i][0], 1e-5 / 12, 1e-17);
    EXPECT_EQ(faces(diagram, i), 6U);
  }
  EXPECT_EQ(diagram.vertices.size(), 11U * 11 * 11);
}

TEST(SpaceCells, OfHexagonalPrismsHaveEightFaces) {
  Sites3 sites;
  for (int z = 0; z < 6; ++z) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) sites.push_back({x + 0.5 * (y % 2), y * std::numbers::sqrt3 / 2, z * 0.9});
    }
  }
  const Diagram3 diagram = cellsOf(sites, {-1, -1, -1, 9, 7.5, 5.5});
  const auto is_inside = inside(diagram);
  std::size_t count = 0;
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    if (!is_inside[i]) continue;
    ++count;
    EXPECT_EQ(faces(diagram, i), 8U);
    EXPECT_NEAR(diagram.volume[i], 0.9 * std::numbers::sqrt3 / 2, 1e-12);
  }
  EXPECT_GT(count, 20U);
}

TEST(SpaceCells, DoNotDependOnTheOrderOfSitesOrOnThreads) {
  for (const Pattern3 pattern : {Pattern3::random, Pattern3::fcc, Pattern3::clusters}) {
    const Sites3 sites = generate(pattern, 2000, 3);
    const Diagram3 one = cellsOf(sites), two = cellsOf(sites, unit_cube, 2);
    EXPECT_EQ(one.volume, two.volume);
    EXPECT_EQ(one.neighbors, two.neighbors);
    EXPECT_EQ(one.face_vertices, two.face_vertices);
    EXPECT_TRUE(std::ranges::equal(one.vertices, two.vertices));
    std::vector<std::size_t> order(sites.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::shuffle(order, std::mt19937_64(5));
    Sites3 shuffled;
    for (const std::size_t i : order) shuffled.push_back(sites[i]);
    const Diagram3 other = cellsOf(shuffled);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::size_t i = order[k];
      std::vector<std::int64_t> mine(
          one.neighbors.begin() + static_cast<std::ptrdiff_t>(one.face_offsets[i]),
          one.neighbors.begin() + static_cast<std::ptrdiff_t>(one.face_offsets[i + 1]));
      std::vector<std::int64_t> theirs;
      for (std::uint64_t f = other.face_offsets[k]; f < other.face_offsets[k + 1]; ++f) {
        const std::int64_t n = other.neighbors[f];
        theirs.push_back(isWall(n) ? n : static_cast<std::int64_t>(order[static_cast<std::size_t>(n)]));
      }
      std::ranges::sort(mine);
      std::ranges::sort(theirs);
      EXPECT_EQ(mine, theirs);
    }
  }
}

TEST(SpaceCells, OfHardSites) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto each = [&](std::size_t count, const auto& place) {
    Sites3 sites;
    for (std::size_t i = 0; i < count; ++i) sites.push_back(place());
    return sites;
  };
  const auto u = [&] { return uniform(random); };
  std::map<std::string, Sites3> kinds;
  for (std::size_t n = 1; n <= 5; ++n)
    kinds["few " + std::to_string(n)] = each(n, [&] { return Point3{u(), u(), u()}; });
  kinds["plane"] = each(200, [&] { return Point3{u(), u(), 0.5}; });
  kinds["line"] = each(100, [&] { return Point3{u(), 0.25, 0.5}; });
  kinds["on walls"] = each(150, [&] { return Point3{u() < 0.5 ? 0.0 : 1.0, u(), u() < 0.5 ? 0.0 : u()}; });
  kinds["outside"] = each(300, [&] { return Point3{3 * u() - 1, 3 * u() - 1, 3 * u() - 1}; });
  kinds["all outside"] = each(50, [&] { return Point3{1.5 + u(), u(), u()}; });
  kinds["duplicates"] = each(500, [&] {
    return Point3{std::floor(4 * u()) / 4, std::floor(4 * u()) / 4, std::floor(4 * u()) / 4};
  });
  kinds["decimals"] = each(1000, [&] {
    return Point3{std::round(u() * 100) / 100, std::round(u() * 100) / 100, std::round(u() * 100) / 100};
  });
  kinds["sphere"] = generate(Pattern3::sphere, 150, 2);
  kinds["sphere"].push_back({0.5, 0.5, 0.5});
  kinds["near pairs"] = each(200, [&] { return Point3{u(), u(), u()}; });
  for (std::size_t i = 0; i < 100; ++i) {
    const Point3 p = kinds["near pairs"][i];
    const double d = std::pow(10.0, -8 - 6 * u());
    kinds["near pairs"].push_back({p.x + d * u(), p.y - d * u(), p.z + d * u()});
  }
  for (const auto& [name, sites] : kinds) {
    SCOPED_TRACE(name);
    cellsOf(sites);
  }
  Sites3 far = kinds["decimals"];
  for (Point3& p : far) p = {p.x + 1e6, p.y - 1e6, p.z + 3e6};
  SCOPED_TRACE("far from the origin");
  cellsOf(far, {1e6, -1e6, 3e6, 1e6 + 1, -1e6 + 1, 3e6 + 1});
}

// Two vertices that are one lie as far from each other as sites of a flat box are apart, not as it is thin.
TEST(SpaceCells, OfAFlatBoxMayBeJoinedAcrossIt) {
  constexpr double height = 0x1p-18, above = 1e-7;
  const double aside = (height / 2 - above) * (height / 2) / 0.25;
  const Diagram3 diagram = cellsOf({{0.3, 0.5, height / 4},
                                    {0.7, 0.3, height / 4},
                                    {0.7, 0.7, height / 4},
                                    {0.3 + aside, 0.5, 3 * height / 4}},
                                   {0, 0, 0, 1, 1, height});
  // The vertex of the four is one with that of three and the wall.
  bool joined = false;
  for (std::size_t v = 0; v < diagram.vertices.size(); ++v)
    joined = joined || diagram.vertex_site_offsets[v + 1] - diagram.vertex_site_offsets[v] == 5;
  EXPECT_TRUE(joined);
}

TEST(SpaceCells, BesideASiteOutsideTheDomain) {
  const Diagram3 diagram = cellsOf({{-1e-185, 0.5, 0.5}, {0, 0.5, 0.5}});
  EXPECT_EQ(diagram.status, (std::vector{Status::empty, Status::ok}));
}

// The fifth power of its side is no double: second moments are infinite, those by symmetry 0 where nothing is
// rounded.
TEST(SpaceCells, OfALargeDomain) {
  constexpr double side = 0x1p252;
  const Diagram3 diagram =
      cellsOf({{0.625 * side, 0.1875 * side, 0.0625 * side}, {0.625 * side, 0.625 * side, 0.625 * side}},
              {0, 0, 0, side, side, side});
  EXPECT_TRUE(std::isinf(diagram.second_moments[0][0]));
}

TEST(SpaceCells, BetweenAWallAndASiteBesideIt) {
  const Sites3 sites{{0, 0.5, 0.5}, {8e-12, 0.5, 0.5}, {0.3, 0.1, 0.2}, {0.3, 0.9, 0.6}};
  for (const Detail3 detail : {Detail3::measures, Detail3::polyhedra}) {
    const Diagram3 diagram = cellsOf(sites, unit_cube, 1, detail);
    EXPECT_EQ(faces(diagram, 0), 2U);
    EXPECT_EQ(diagram.flat, 1U);
  }
}

// The squares of distances to them differ by less than a double's last bit.
TEST(SpaceCells, OfSitesAHairApart) {
  const Diagram3 diagram = cellsOf({{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5 - 0x1p-52}});
  EXPECT_EQ(diagram.volume, (std::vector{0.5, 0.5}));
}

// Doubles do not tell which of the sites is nearest.
TEST(SpaceCells, OfADomainFarFromItsSites) {
  const double x = 0x1p51, y = 1.5 * 0x1p52;
  const Diagram3 diagram =
      cellsOf({{0.25, 0.5, 0.5}, {0.25, 0.75, 0.5}, {0.25, 0.75 + 0x1p-30, 0.5}}, {x, y, 0, x + 1, y + 1, 1});
  EXPECT_EQ(diagram.status, (std::vector{Status::empty, Status::empty, Status::ok}));
}

std::string refusalOf(const Sites3& sites, const Box3& domain) {
  auto session = Session::open({});
  EXPECT_TRUE(session.has_value());
  const auto diagram = session->cells(std::span<const Point3>(sites), {domain, Detail3::polyhedra, {}});
  EXPECT_FALSE(diagram.has_value());
  return diagram ? "" : diagram.error().message;
}

TEST(SpaceCells, RefuseSitesThatAreTooNear) {
  const std::string end =
      " are not equal, but nearer to each other than 8e-25 of the domain's longest side: make them equal, or "
      "move one";
  EXPECT_EQ(refusalOf({{0.5, 0.5, 0.5}, {0, 1e-27, 0}, {0, 0, 0}}, unit_cube),
            "sites 1 and 2: 0, 1e-27, 0 and 0, 0, 0" + end);
  // In units of this domain both are 0.
  EXPECT_EQ(refusalOf({{1e99, 1, 1}, {1e-310, 0, 0}, {2e-310, 0, 0}}, {0, 0, 0, 1e100, 1e100, 1e100}),
            "sites 1 and 2: 1e-310, 0, 0 and 2e-310, 0, 0" + end);
}

// Meijering 1953: mean numbers of a Poisson-Voronoi diagram. Cells near walls are left out.
TEST(SpaceCells, OfWhiteNoiseHaveTheMeansOfTheory) {
  const Sites3 sites = generate(Pattern3::random, 40000, 9);
  const Diagram3 diagram = cellsOf(sites, unit_cube, 2);
  double count = 0, sum = 0, squares = 0;
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    const Point3& p = sites[i];
    const double margin = std::min({p.x, 1 - p.x, p.y, 1 - p.y, p.z, 1 - p.z});
    if (margin < 0.15) continue;
    const auto n = static_cast<double>(faces(diagram, i));
    ++count;
    sum += n;
    squares += n * n;
  }
  const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);
  const double theory = 48 * std::numbers::pi * std::numbers::pi / 35 + 2;
  EXPECT_NEAR(mean, theory, 3 * error);
}

}  // namespace
}  // namespace vorpipe
