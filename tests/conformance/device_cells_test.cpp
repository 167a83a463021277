// What the device backends answer when they are asked for cells as data. Compiled into the tests of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "backend_scene.h"
#include "layout.glsl"

namespace vorpipe::test {
namespace {

using LineOf = std::function<HalfPlane<double>(std::int32_t)>;

struct Vertex {
  double x, y;
};

Vertex crossing(const HalfPlane<double>& a, const HalfPlane<double>& b) {
  const double sine = a.nx * b.ny - a.ny * b.nx;
  return {(a.h * b.ny - b.h * a.ny) / sine, (b.h * a.nx - a.h * b.nx) / sine};
}

// The area between the lines of a cell's neighbors, in their order.
double areaOf(std::span<const std::int32_t> neighbors, const LineOf& line_of) {
  std::vector<Vertex> vertices;
  for (std::size_t k = 0; k < neighbors.size(); k++) {
    vertices.push_back(crossing(line_of(neighbors[k]), line_of(neighbors[(k + 1) % neighbors.size()])));
  }
  double area = 0;
  for (std::size_t k = 0; k < vertices.size(); k++) {
    const Vertex& a = vertices[k];
    const Vertex& b = vertices[(k + 1) % vertices.size()];
    area += (a.x * b.y - b.x * a.y) / 2;
  }
  return area;
}

std::span<const std::int32_t> neighborsOf(const CellNeighbors& cells, std::size_t entry) {
  return std::span(cells.neighbor)
      .subspan(cells.offsets[entry], cells.offsets[entry + 1] - cells.offsets[entry]);
}

// Expects each row to begin at its smallest number.
void expectRowsFromSmallest(const CellNeighbors& cells) {
  for (std::size_t entry = 0; entry < cells.status.size(); entry++) {
    const auto row = neighborsOf(cells, entry);
    ASSERT_TRUE(row.empty() || row.front() == *std::min_element(row.begin(), row.end())) << "entry " << entry;
  }
}

HalfPlane<double> wallOf(const CellBatch<double>::Entry& entry, std::int32_t wall) {
  const HalfPlane<double> walls[] = {
      {-1, 0, -entry.west, 0}, {1, 0, entry.east, 0}, {0, -1, -entry.south, 0}, {0, 1, entry.north, 0}};
  return walls[-1 - wall];
}

// Expects the lists of a scene to become cells that fill the domain.
void expectListsToTile(Backend& backend, const Scene& scene) {
  CellNeighbors cells;
  const Result<void> done = backend.cells(scene.batch, cells);
  ASSERT_TRUE(done.has_value()) << done.error().message;
  ASSERT_EQ(cells.status, std::vector(scene.set.size(), CellStatus::certified));
  ASSERT_EQ(cells.offsets.size(), scene.set.size() + 1);
  expectRowsFromSmallest(cells);
  double area = 0;
  for (std::size_t cell = 0; cell < cells.status.size(); cell++) {
    const auto& entry = scene.batch.entries[cell];
    for (const std::int32_t line : neighborsOf(cells, cell)) {
      ASSERT_GE(line, -4);
      ASSERT_LT(line, static_cast<std::int32_t>(entry.count));
    }
    area += areaOf(neighborsOf(cells, cell), [&](std::int32_t line) {
      if (line < 0) return wallOf(entry, line);
      return scene.batch.lines[entry.first + static_cast<std::size_t>(line)];
    });
  }
  EXPECT_NEAR(area, 1.0, 1e-6);
}

// The cells of sites, asked for in as many calls as the device's limits ask for.
CellNeighbors cellsInCalls(Backend& backend, std::span<const std::uint32_t> which, Capacity capacity) {
  CellNeighbors all;
  all.offsets.push_back(0);
  for (std::size_t begin = 0; begin < which.size(); begin += backend.info().max_entries) {
    const std::size_t count = std::min<std::size_t>(backend.info().max_entries, which.size() - begin);
    CellNeighbors part;
    const Result<void> done = backend.cells(which.subspan(begin, count), capacity, part);
    EXPECT_TRUE(done.has_value()) << done.error().message;
    all.status.insert(all.status.end(), part.status.begin(), part.status.end());
    for (std::size_t k = 0; k < count; k++) all.offsets.push_back(all.neighbor.size() + part.offsets[k + 1]);
    all.neighbor.insert(all.neighbor.end(), part.neighbor.begin(), part.neighbor.end());
  }
  return all;
}

// Expects the sites of a scene to become cells that fill the domain, and to be each other's neighbors.
void expectSitesToTile(Backend& backend, const Scene& scene) {
  const SiteSet& set = scene.set;
  ASSERT_TRUE(backend.upload(set, {}).has_value());
  std::set<std::pair<std::size_t, std::int32_t>> edges;
  double area = 0;
  auto wanted = range(0, set.size());
  for (const Capacity capacity : {Capacity::small, Capacity::large}) {
    const CellNeighbors cells = cellsInCalls(backend, wanted, capacity);
    ASSERT_EQ(cells.status.size(), wanted.size());
    ASSERT_EQ(cells.offsets.size(), wanted.size() + 1);
    expectRowsFromSmallest(cells);
    for (std::size_t k = 0; k < wanted.size(); k++) {
      const std::size_t site = wanted[k];
      for (const std::int32_t other : neighborsOf(cells, k)) edges.insert({site, other});
      area += areaOf(neighborsOf(cells, k), [&](std::int32_t other) {
        if (other < 0) return wallOf(scene.batch.entries[site], other);
        const double dx = set.x[static_cast<std::size_t>(other)] - set.x[site];
        const double dy = set.y[static_cast<std::size_t>(other)] - set.y[site];
        const double distance = std::hypot(dx, dy);
        return HalfPlane<double>{dx / distance, dy / distance, distance / 2, 0};
      });
    }
    wanted = overflown(wanted, capacity, cells.status);
  }
  EXPECT_NEAR(area, 1.0, 1e-6);
  for (const auto& [site, other] : edges) {
    if (other < 0) continue;
    EXPECT_TRUE(edges.contains({static_cast<std::size_t>(other), static_cast<std::int32_t>(site)}))
        << "sites " << site << " and " << other;
  }
}

TEST(DeviceCells, OfListsTileTheDomain) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  expectListsToTile(*backend, makeScene(400));
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

TEST(DeviceCells, OfSitesTileTheDomain) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  for (const std::size_t count : {1U, 2U, 3U, 10U, 700U}) expectSitesToTile(*backend, makeScene(count));
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

TEST(DeviceCells, TileTheDomainWithinMaskedLimits) {
  const auto backend =
      openBackend({{}, {{"maxTexelBufferElements", 65536}, {"maxStorageBufferRange", 4096}}});
  ASSERT_TRUE(backend);
  EXPECT_EQ(backend->info().max_sites, 65536U);
  EXPECT_EQ(backend->info().max_bins, 65535U);
  EXPECT_EQ(backend->info().max_lines, 65536U);
  expectListsToTile(*backend, makeScene(100));
  expectSitesToTile(*backend, makeScene(250));
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

TEST(DeviceCells, ComeInTheOrderAskedFor) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  const Scene scene = makeScene(200);
  ASSERT_TRUE(backend->upload(scene.set, {}).has_value());
  CellNeighbors all;
  ASSERT_TRUE(backend->cells(range(0, 200), Capacity::large, all).has_value());
  const std::vector<std::uint32_t> wanted = {150, 3, 199, 0, 3};
  CellNeighbors some;
  ASSERT_TRUE(backend->cells(wanted, Capacity::large, some).has_value());
  ASSERT_EQ(some.status.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); k++) {
    const auto expected = neighborsOf(all, wanted[k]);
    EXPECT_TRUE(std::ranges::equal(neighborsOf(some, k), expected)) << "entry " << k;
  }
  ASSERT_TRUE(backend->cells(std::span<const std::uint32_t>{}, Capacity::small, some).has_value());
  EXPECT_TRUE(some.status.empty() && some.neighbor.empty());
  EXPECT_EQ(some.offsets, BigVector<std::uint64_t>{0});
}

// A tile: what lies beyond the box that it knows may cut its outer cells.
TEST(DeviceCells, AreUnsecuredWhereUnknownSitesMayCut) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  Scene scene = makeScene(400);
  scene.set.coverage = {0.25, 0.25, 0.75, 0.75};
  ASSERT_TRUE(backend->upload(scene.set, {}).has_value());
  CellNeighbors cells;
  ASSERT_TRUE(backend->cells(range(0, 400), Capacity::large, cells).has_value());
  int certified = 0;
  for (std::size_t i = 0; i < 400; i++) {
    const double x = std::abs(scene.set.x[i] - 0.5);
    const double y = std::abs(scene.set.y[i] - 0.5);
    const auto away = std::max(x, y);
    if (away > 0.25 || away < 0.05) {
      EXPECT_EQ(cells.status[i], away > 0.25 ? CellStatus::unsecured : CellStatus::certified) << "site " << i;
    }
    certified += cells.status[i] == CellStatus::certified ? 1 : 0;
    EXPECT_EQ(neighborsOf(cells, i).empty(), cells.status[i] != CellStatus::certified);
  }
  EXPECT_GT(certified, 20);
}

// Floats do not tell these two apart, and must not say that they do.
TEST(DeviceCells, OfSitesThatFloatsCannotTellApartAreNotCertified) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  Sites sites = generate(Pattern::random, 50, 7);
  sites.x.insert(sites.x.end(), {0.1, std::nextafter(0.1, 1.0)});
  sites.y.insert(sites.y.end(), {0.3, 0.3});
  const SiteSet set = prepared(sites);
  ASSERT_EQ(set.size(), 52U);
  ASSERT_TRUE(backend->upload(set, {}).has_value());
  CellNeighbors cells;
  ASSERT_TRUE(backend->cells(range(0, 52), Capacity::large, cells).has_value());
  for (std::size_t k = 0; k < 52; k++) {
    EXPECT_EQ(cells.status[k] == CellStatus::certified, set.id[k] < 50) << "site " << set.id[k];
  }
}

// More sites in one bin than a search tries.
TEST(DeviceCells, GiveUpInACrowd) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  Sites sites = generate(Pattern::random, 20000, 7);
  for (double& x : sites.x) x = 0.5 + 1e-6 * x;
  for (double& y : sites.y) y = 0.5 + 1e-6 * y;
  sites.x.insert(sites.x.end(), {0.0, 1.0});
  sites.y.insert(sites.y.end(), {0.0, 1.0});
  const SiteSet set = prepared(sites);
  ASSERT_TRUE(backend->upload(set, {}).has_value());
  CellNeighbors cells;
  ASSERT_TRUE(backend->cells(range(0, 100), Capacity::small, cells).has_value());
  for (std::size_t k = 1; k < 100; k++) EXPECT_EQ(cells.status[k], CellStatus::unsecured) << "site " << k;
}

TEST(DeviceCells, DoNotDependOnTheNumberOfThreads) {
  const SiteSet set = prepared(generate(Pattern::random, 70000, 7));
  std::vector<CellNeighbors> found;
  for (const int threads : {1, 2, 3}) {
    const auto backend = openBackend({}, threads);
    ASSERT_TRUE(backend);
    ASSERT_TRUE(backend->upload(set, {}).has_value());
    ASSERT_TRUE(backend->cells(range(0, set.size()), Capacity::small, found.emplace_back()).has_value());
  }
  for (const CellNeighbors& cells : found) {
    EXPECT_EQ(cells.status, found[0].status);
    EXPECT_EQ(cells.offsets, found[0].offsets);
    EXPECT_EQ(cells.neighbor, found[0].neighbor);
  }
}

}  // namespace
}  // namespace vorpipe::test
