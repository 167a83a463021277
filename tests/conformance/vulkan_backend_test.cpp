// The backend "vulkan-geometry" on scenes of its own, with the validation layers listening.
#include <gtest/gtest.h>

#include <numeric>

#include "backend/vulkan/vulkan_backend.h"
#include "layout.glsl"
#include "vulkan_scene.h"

namespace vorpipe::test {
namespace {

constexpr std::uint64_t seed = 7;

std::unique_ptr<Backend> open(const Mask& mask = {}) {
  BackendOptions options;
  options.mask = mask;
  options.validation = true;
  Result<std::unique_ptr<Backend>> backend = makeVulkanGeometryBackend(options);
  if (!backend) {
    ADD_FAILURE() << backend.error().message;
    return nullptr;
  }
  return std::move(*backend);
}

struct Picture {
  std::vector<std::uint32_t> rgba, ids;
};

Picture read(Backend& backend, const View& view) {
  const auto pixels = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
  Picture picture{std::vector<std::uint32_t>(pixels), std::vector<std::uint32_t>(pixels)};
  const Result<void> done = backend.read(picture.rgba, picture.ids);
  EXPECT_TRUE(done.has_value()) << done.error().message;
  return picture;
}

// Draws some entries of the scene and expects them to be certified, except that cells may need more
// room than `room`. Returns those.
std::vector<std::size_t> draw(Backend& backend, const Scene& scene, const std::vector<std::size_t>& chosen,
                              Room room) {
  CellBatch<float> batch = toFloat(scene.batch);
  std::vector<CellBatch<float>::Entry> entries;
  std::vector<DrawMark> marks;
  for (const std::size_t entry : chosen) {
    entries.push_back(batch.entries[entry]);
    marks.push_back(scene.marks[entry]);
  }
  batch.entries = std::move(entries);
  std::vector<CellStatus> status(chosen.size());
  const Result<void> done = backend.draw(batch, marks, room, status);
  EXPECT_TRUE(done.has_value()) << done.error().message;
  std::vector<std::size_t> overflown;
  for (std::size_t k = 0; k < status.size(); k++) {
    if (status[k] == CellStatus::overflow && room == Room::fast) {
      overflown.push_back(chosen[k]);
    } else {
      EXPECT_EQ(status[k], CellStatus::certified) << "entry " << chosen[k];
    }
  }
  return overflown;
}

std::vector<std::size_t> range(std::size_t first, std::size_t last) {
  std::vector<std::size_t> entries(last - first);
  std::iota(entries.begin(), entries.end(), first);
  return entries;
}

TEST(VulkanBackend, DrawsEveryPixelToItsNearestSite) {
  const auto backend = open();
  ASSERT_TRUE(backend);
  const Scene scene = makeScene(300, seed);
  const View view = makeView(501, 333);
  ASSERT_TRUE(backend->begin(view).has_value());
  const auto overflown = draw(*backend, scene, range(0, 200), Room::fast);
  EXPECT_LT(overflown.size(), 20U);
  draw(*backend, scene, range(200, 300), Room::most);
  draw(*backend, scene, overflown, Room::most);
  const Picture picture = read(*backend, view);
  for (int row = 0; row < view.height; row++) {
    for (int column = 0; column < view.width; column++) {
      const auto pixel = static_cast<std::size_t>(row * view.width + column);
      const std::uint32_t id = picture.ids[pixel];
      ASSERT_NE(id, no_site) << "row " << row << " column " << column;
      ASSERT_EQ(picture.rgba[pixel], view.palette[id % 256]);
      ASSERT_LT(pixelError(scene.sites, view, row, column, id), 1.0 / 128)
          << "row " << row << " column " << column << " site " << id;
    }
  }
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

TEST(VulkanBackend, BeginsAnewAndInAnotherSize) {
  const auto backend = open();
  ASSERT_TRUE(backend);
  const Scene scene = makeScene(20, seed);
  std::vector<Picture> pictures;
  for (const int size : {64, 300, 64}) {
    const View view = makeView(size, size);
    ASSERT_TRUE(backend->begin(view).has_value());
    for (const std::uint32_t id : read(*backend, view).ids) ASSERT_EQ(id, no_site);
    draw(*backend, scene, range(0, 20), Room::most);
    pictures.push_back(read(*backend, view));
  }
  EXPECT_EQ(pictures[0].ids, pictures[2].ids);
  EXPECT_EQ(pictures[0].rgba, pictures[2].rgba);
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

TEST(VulkanBackend, AnswersEachEntryWithItsOwnStatus) {
  const auto backend = open();
  ASSERT_TRUE(backend);
  const View view = makeView(16, 16);
  ASSERT_TRUE(backend->begin(view).has_value());
  constexpr int edges = EDGES_FAST + 2;
  ASSERT_LE(edges + 2, backend->info().most_edges);
  // Certified; lines that leave nothing; a neighbor that might lie within reach; more edges than the
  // fast pipeline has room for.
  CellBatch<float> batch;
  const float far = std::numeric_limits<float>::infinity();
  batch.entries = {{0, 0, -1, -1, 1, 1, far, 0},
                   {0, 2, -1, -1, 1, 1, far, 0},
                   {0, 0, -1, -1, 1, 1, 0.5F, 0},
                   {2, edges, -1, -1, 1, 1, far, 0}};
  batch.lines = {{1, 0, -0.25F, 0}, {-1, 0, -0.25F, 0}};
  for (int k = 0; k < edges; k++) {
    const double angle = (k + 0.3) * 2 * std::acos(-1.0) / edges;
    batch.lines.push_back(
        {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.5F, 1.0F});
  }
  const std::vector<DrawMark> marks(4, DrawMark{0, 0, 1, 1});
  std::vector<CellStatus> status(4);
  ASSERT_TRUE(backend->draw(batch, marks, Room::fast, status).has_value());
  EXPECT_EQ(status, (std::vector{CellStatus::certified, CellStatus::empty, CellStatus::unsecured,
                                 CellStatus::overflow}));
  ASSERT_TRUE(backend->draw(batch, marks, Room::most, status).has_value());
  EXPECT_EQ(status[3], CellStatus::certified);
  EXPECT_TRUE(backend->draw({}, {}, Room::fast, {}).has_value());
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

void expectPartition(Backend& backend, const Scene& scene) {
  CellPolygons cells;
  const Result<void> done = backend.cells(scene.batch, cells);
  ASSERT_TRUE(done.has_value()) << done.error().message;
  ASSERT_EQ(cells.status.size(), scene.sites.size());
  ASSERT_EQ(cells.first.size(), scene.sites.size() + 1);
  double area = 0;
  for (std::size_t cell = 0; cell < cells.status.size(); cell++) {
    ASSERT_EQ(cells.status[cell], CellStatus::certified);
    const CellBatch<double>::Entry& entry = scene.batch.entries[cell];
    for (std::size_t k = cells.first[cell]; k < cells.first[cell + 1]; k++) {
      const std::size_t next = k + 1 < cells.first[cell + 1] ? k + 1 : cells.first[cell];
      area += (cells.x[k] * cells.y[next] - cells.x[next] * cells.y[k]) / 2;
      if (cells.line[k] < 0) continue;
      ASSERT_LT(cells.line[k], static_cast<std::int32_t>(entry.count));
      const Line<double>& line = scene.batch.lines[entry.first + static_cast<std::uint32_t>(cells.line[k])];
      for (const std::size_t end : {k, next}) {
        EXPECT_NEAR(cells.x[end] * line.nx + cells.y[end] * line.ny, line.h, 1e-6);
      }
    }
  }
  EXPECT_NEAR(area, 1.0, 1e-6);
}

TEST(VulkanBackend, HandsCellsBackThatTileTheDomain) {
  const auto backend = open();
  ASSERT_TRUE(backend);
  expectPartition(*backend, makeScene(400, seed));
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

TEST(VulkanBackend, KeepsToMaskedLimits) {
  const auto backend = open({{}, {{"maxTexelBufferElements", 65536}, {"maxStorageBufferRange", 4096}}});
  ASSERT_TRUE(backend);
  EXPECT_EQ(backend->info().max_lines, 65536U);
  EXPECT_EQ(backend->info().max_entries, 1024U);
  // 4096 bytes hold the edges of 8 cells at a time.
  expectPartition(*backend, makeScene(100, seed));
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

}  // namespace
}  // namespace vorpipe::test
