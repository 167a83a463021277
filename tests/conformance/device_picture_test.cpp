// What the device backends draw. Compiled into the tests of each.
#include <gtest/gtest.h>

#include "backend_scene.h"
#include "layout.glsl"

namespace vorpipe::test {
namespace {

TEST(DevicePicture, OfListsShowsNearestSites) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  const Scene scene = makeScene(300);
  const View view = makeView(501, 333);
  ASSERT_TRUE(backend->begin(view).has_value());
  const auto again = drawLists(*backend, scene, range(0, 200), Capacity::small);
  EXPECT_LT(again.size(), 20U);
  drawLists(*backend, scene, range(200, 300), Capacity::large);
  drawLists(*backend, scene, again, Capacity::large);
  expectPicture(read(*backend, view), scene, view);
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

TEST(DevicePicture, OfSitesShowsNearestSites) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  for (const std::size_t count : {2U, 700U}) {
    const Scene scene = makeScene(count);
    const View view = makeView(501, 333);
    ASSERT_TRUE(backend->upload(scene.set, scene.palette_index).has_value());
    ASSERT_TRUE(backend->begin(view).has_value());
    const auto again = drawSites(*backend, range(0, count / 2), Capacity::small);
    drawSites(*backend, again, Capacity::large);
    drawSites(*backend, range(count / 2, count), Capacity::large);
    expectPicture(read(*backend, view), scene, view);
  }
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

// Sites far from the origin of coordinates, and sites outside the domain.
TEST(DevicePicture, OfSitesElsewhereShowsNearestSites) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  Sites sites = generate(Pattern::random, 300, 7);
  for (double& x : sites.x) x = 2 * x - 0.5;
  for (double& y : sites.y) y = 2 * y - 0.5;
  const View view = makeView(300, 300);
  const SiteSet set = prepared(sites);
  ASSERT_TRUE(backend->upload(set, std::vector<std::uint8_t>(set.size())).has_value());
  ASSERT_TRUE(backend->begin(view).has_value());
  auto left = range(0, set.size());
  for (const Capacity capacity : {Capacity::small, Capacity::large}) {
    std::vector<CellStatus> status(left.size());
    ASSERT_TRUE(backend->draw(left, capacity, status).has_value());
    std::erase_if(left, [&, k = std::size_t{0}](std::uint32_t) mutable {
      const CellStatus was = status[k++];
      return was == CellStatus::certified || was == CellStatus::empty;
    });
  }
  EXPECT_TRUE(left.empty());
  expectNearestEverywhere(read(*backend, view), sites, unit);
}

TEST(DevicePicture, OfAPartIsThatPartOfTheWhole) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  const Scene scene = makeScene(100);
  const View part{{0.25, 0.5, 0.5, 0.75}, 128, 128, {}};
  std::vector<Image> images;
  for (const View& view : {makeView(512, 512), part}) {
    ASSERT_TRUE(backend->begin(view).has_value());
    ASSERT_TRUE(backend->upload(scene.set, scene.palette_index).has_value());
    drawSites(*backend, range(0, 100), Capacity::large);
    images.push_back(read(*backend, view));
  }
  int differing = 0;
  for (std::size_t row = 0; row < 128; row++) {
    for (std::size_t column = 0; column < 128; column++) {
      const auto whole = images[0].ids[(row + 128) * 512 + column + 128];
      differing += images[1].ids[row * 128 + column] != whole ? 1 : 0;
    }
  }
  EXPECT_LT(differing, 16) << "but for ties";
}

TEST(DevicePicture, BeginsAnewAndInAnotherSize) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  const Scene scene = makeScene(20);
  std::vector<Image> pictures;
  for (const int size : {64, 300, 64}) {
    const View view = makeView(size, size);
    ASSERT_TRUE(backend->begin(view).has_value());
    for (const std::uint32_t id : read(*backend, view).ids) ASSERT_EQ(id, no_site);
    drawLists(*backend, scene, range(0, 20), Capacity::large);
    pictures.push_back(read(*backend, view));
  }
  EXPECT_EQ(pictures[0].ids, pictures[2].ids);
  EXPECT_EQ(pictures[0].rgba, pictures[2].rgba);
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

TEST(DevicePicture, AnswersEachEntryWithItsOwnStatus) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  ASSERT_TRUE(backend->begin(makeView(16, 16)).has_value());
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
  ASSERT_TRUE(backend->draw(batch, marks, Capacity::small, status).has_value());
  EXPECT_EQ(status, (std::vector{CellStatus::certified, CellStatus::empty, CellStatus::unsecured,
                                 CellStatus::overflow}));
  ASSERT_TRUE(backend->draw(batch, marks, Capacity::large, status).has_value());
  EXPECT_EQ(status[3], CellStatus::certified);
  EXPECT_TRUE(backend->draw(CellBatch<float>{}, {}, Capacity::small, {}).has_value());
  EXPECT_TRUE(backend->draw(std::span<const std::uint32_t>{}, Capacity::small, {}).has_value());
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

TEST(DevicePicture, DoesNotDependOnTheNumberOfThreads) {
  const Sites sites = generate(Pattern::random, 70000, 7);
  const SiteSet set = prepared(sites);
  const View view = makeView(200, 200);
  std::vector<Image> images;
  for (const int threads : {1, 2, 3}) {
    const auto backend = openBackend({}, threads);
    ASSERT_TRUE(backend);
    ASSERT_TRUE(backend->upload(set, std::vector<std::uint8_t>(set.size(), 9)).has_value());
    ASSERT_TRUE(backend->begin(view).has_value());
    std::vector<CellStatus> status(set.size());
    ASSERT_TRUE(backend->draw(range(0, set.size()), Capacity::small, status).has_value());
    images.push_back(read(*backend, view));
  }
  for (const Image& image : images) {
    EXPECT_EQ(image.ids, images[0].ids);
    EXPECT_EQ(image.rgba, images[0].rgba);
  }
}

}  // namespace
}  // namespace vorpipe::test
