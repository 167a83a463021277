// The backend "opengl" on scenes of its own.
#include "backend/opengl/opengl_backend.h"

#include <epoxy/egl.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "layout.glsl"
#include "vulkan_scene.h"

namespace vorpipe::test {
namespace {

constexpr std::uint64_t seed = 7;

std::unique_ptr<Backend> open(const Mask& mask = {}) {
  BackendOptions options;
  options.mask = mask;
  Result<std::unique_ptr<Backend>> backend = makeOpenGlBackend(options);
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

// Draws the scene's entries first .. last - 1 with the most room.
void draw(Backend& backend, const Scene& scene, std::size_t first, std::size_t last) {
  CellBatch<float> batch = toFloat(scene.batch);
  batch.entries = {batch.entries.begin() + static_cast<std::ptrdiff_t>(first),
                   batch.entries.begin() + static_cast<std::ptrdiff_t>(last)};
  std::vector<CellStatus> status(last - first);
  const Result<void> done =
      backend.draw(batch, std::span(scene.marks).subspan(first, last - first), Room::most, status);
  ASSERT_TRUE(done.has_value()) << done.error().message;
  EXPECT_EQ(status, std::vector(last - first, CellStatus::certified));
}

TEST(OpenGlBackend, RunsOnLlvmpipeWhereSoftwareIsForced) {
  if (std::getenv("LIBGL_ALWAYS_SOFTWARE") == nullptr) GTEST_SKIP() << "LIBGL_ALWAYS_SOFTWARE is not set";
  const auto backend = open();
  ASSERT_TRUE(backend);
  EXPECT_TRUE(backend->info().device.name.starts_with("llvmpipe")) << backend->info().device.name;
  EXPECT_EQ(backend->info().device.type, "cpu");
}

TEST(OpenGlBackend, DrawsEveryPixelToItsNearestSite) {
  const auto backend = open();
  ASSERT_TRUE(backend);
  const Scene scene = makeScene(300, seed);
  const View view = makeView(501, 333);
  ASSERT_TRUE(backend->begin(view).has_value());
  draw(*backend, scene, 0, 100);
  draw(*backend, scene, 100, 300);
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
}

TEST(OpenGlBackend, AnswersEachEntryWithItsOwnStatus) {
  const auto backend = open();
  ASSERT_TRUE(backend);
  ASSERT_TRUE(backend->begin(makeView(16, 16)).has_value());
  constexpr int edges = EDGES_FAST + 2;
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
}

// More entries than transform feedback has room for at once.
TEST(OpenGlBackend, AnswersEveryEntryOfALargeBatch) {
  const auto backend = open();
  ASSERT_TRUE(backend);
  constexpr std::size_t count = 300001;
  ASSERT_LE(count, backend->info().max_entries);
  const View view = makeView(1, 1);
  ASSERT_TRUE(backend->begin(view).has_value());
  CellBatch<float> batch;
  std::vector<DrawMark> marks;
  for (std::uint32_t k = 0; k < count; k++) {
    // Every third is without a proof.
    const float reach = k % 3 == 0 ? 0.5F : std::numeric_limits<float>::infinity();
    batch.entries.push_back({0, 0, -1, -1, 1, 1, reach, 0});
    marks.push_back({0, 0, k, 0});
  }
  std::vector<CellStatus> status(count);
  const Result<void> done = backend->draw(batch, marks, Room::most, status);
  ASSERT_TRUE(done.has_value()) << done.error().message;
  for (std::size_t k = 0; k < count; k++) {
    ASSERT_EQ(status[k], k % 3 == 0 ? CellStatus::unsecured : CellStatus::certified) << "entry " << k;
  }
  // The last one is without a proof, and the one before is drawn over all others.
  EXPECT_EQ(read(*backend, view).ids[0], count - 2);
}

TEST(OpenGlBackend, HandsCellsBackThatFillTheDomain) {
  const auto backend = open();
  ASSERT_TRUE(backend);
  const Scene scene = makeScene(300, seed);
  CellPolygons cells;
  const Result<void> done = backend->cells(scene.batch, cells);
  ASSERT_TRUE(done.has_value()) << done.error().message;
  ASSERT_EQ(cells.first.size(), 301U);
  double area = 0;
  for (std::size_t cell = 0; cell < 300; cell++) {
    EXPECT_EQ(cells.status[cell], CellStatus::certified);
    const std::size_t begin = cells.first[cell];
    const std::size_t end = cells.first[cell + 1];
    for (std::size_t k = begin; k < end; k++) {
      const std::size_t next = k + 1 < end ? k + 1 : begin;
      area += (cells.x[k] * cells.y[next] - cells.x[next] * cells.y[k]) / 2;
      if (cells.line[k] < 0) continue;
      const auto& entry = scene.batch.entries[cell];
      const auto& line = scene.batch.lines[entry.first + static_cast<std::size_t>(cells.line[k])];
      for (const std::size_t v : {k, next}) {
        EXPECT_NEAR(cells.x[v] * line.nx + cells.y[v] * line.ny, line.h, 1e-6);
      }
    }
  }
  EXPECT_NEAR(area, 1, 1e-5);
}

TEST(OpenGlBackend, LeavesTheThreadWithTheContextThatWasCurrent) {
  const auto first = open();
  const auto second = open();
  ASSERT_TRUE(first && second);
  const Scene scene = makeScene(20, seed);
  const View view = makeView(64, 64);
  for (Backend* backend : {first.get(), second.get()}) ASSERT_TRUE(backend->begin(view).has_value());
  draw(*first, scene, 0, 20);
  EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
  for (const std::uint32_t id : read(*second, view).ids) ASSERT_EQ(id, no_site);
  draw(*second, scene, 0, 20);
  EXPECT_EQ(read(*first, view).ids, read(*second, view).ids);
}

TEST(OpenGlBackend, TakesAMaskForTheDevice) {
  const auto lowered = open({{}, {{"maxTexelBufferElements", 65536}}});
  ASSERT_TRUE(lowered);
  EXPECT_EQ(lowered->info().max_lines, 65536U);
  BackendOptions options;
  options.mask.disabled = {"geometryShader"};
  const auto without = makeOpenGlBackend(options);
  ASSERT_FALSE(without.has_value());
  EXPECT_EQ(without.error().code, ErrorCode::device);
  EXPECT_NE(without.error().message.find("geometryShader"), std::string::npos) << without.error().message;
  EXPECT_FALSE(listOpenGlDevices(options.mask).at(0).usable);
  options.mask.disabled = {"flux"};
  EXPECT_EQ(makeOpenGlBackend(options).error().code, ErrorCode::input);
}

TEST(OpenGlBackend, TakesTheDeviceThatIsNamed) {
  const auto devices = listOpenGlDevices({});
  ASSERT_FALSE(devices.empty());
  BackendOptions options;
  for (const auto& wanted : {std::string("0"), devices[0].name.substr(0, 4)}) {
    options.device = wanted;
    EXPECT_TRUE(makeOpenGlBackend(options).has_value()) << wanted;
  }
  for (const char* wanted : {"99", "no such name"}) {
    options.device = wanted;
    const auto none = makeOpenGlBackend(options);
    ASSERT_FALSE(none.has_value());
    EXPECT_EQ(none.error().code, ErrorCode::device);
  }
}

// In a process of its own, because EGL reads its list of drivers once.
TEST(OpenGlBackendDeathTest, SaysWhyWithoutAnEglDriver) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto open_without_drivers = [] {
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", 1);
    const auto backend = makeOpenGlBackend({});
    const auto listed = listOpenGlDevices({});
    const bool refused = !backend && backend.error().code == ErrorCode::device &&
                         backend.error().message.find("install") != std::string::npos;
    std::_Exit(refused && listed.size() == 1 && !listed[0].usable && !listed[0].reason.empty() ? 0 : 1);
  };
  EXPECT_EXIT(open_without_drivers(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace vorpipe::test
