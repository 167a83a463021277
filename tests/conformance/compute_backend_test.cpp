// What is the backend's "vulkan-compute" alone; device_*_test.cpp is compiled with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "backend/vulkan/compute.h"
#include "backend/vulkan/vulkan_backend.h"
#include "backend_scene.h"

namespace vorpipe::test {

std::unique_ptr<Backend> openBackend(const Mask& mask, int threads) {
  BackendOptions options;
  options.mask = mask;
  options.threads = threads;
  options.validation = true;
  Result<std::unique_ptr<Backend>> backend = makeVulkanComputeBackend(options);
  if (!backend) {
    ADD_FAILURE() << backend.error().message;
    return nullptr;
  }
  return std::move(*backend);
}

std::string_view backendName() { return "vulkan-compute"; }

Result<std::unique_ptr<Backend>> tryBackend() {
  BackendOptions options;
  options.validation = true;
  return makeVulkanComputeBackend(options);
}

namespace {

using vulkan::ComputeBackend;
using vulkan::SiteSorter;

// The backend as it is on a device that is not the host, on any device.
std::unique_ptr<Backend> openSortedBy(SiteSorter sorter, const Mask& mask = {}) {
  Result<vulkan::Instance> instance = vulkan::Instance::open(true);
  if (!instance) {
    ADD_FAILURE() << instance.error().message;
    return nullptr;
  }
  const auto devices = vulkan::enumerate(*instance, mask, vulkan::Pipeline::compute);
  const auto physical = devices ? vulkan::choose(*devices, "") : tl::unexpected(devices.error());
  if (!physical) {
    ADD_FAILURE() << physical.error().message;
    return nullptr;
  }
  auto backend = ComputeBackend::open(std::move(*instance), *physical, sorter);
  if (!backend) {
    ADD_FAILURE() << backend.error().message;
    return nullptr;
  }
  return std::move(*backend);
}

// The host and the device sort sites into bins; the answers must not depend on which does.
class BothSorters : public testing::Test {
 protected:
  void SetUp() override {
    host_ = openSortedBy(SiteSorter::host);
    device_ = openSortedBy(SiteSorter::device);
    ASSERT_TRUE(host_ && device_);
  }

  void expectSilence() {
    EXPECT_EQ(host_->validationMessages(), std::vector<std::string>());
    EXPECT_EQ(device_->validationMessages(), std::vector<std::string>());
  }

  std::unique_ptr<Backend> host_, device_;
};

class OfSites : public BothSorters, public testing::WithParamInterface<Pattern> {};

std::vector<std::int32_t> sortedRow(const CellNeighbors& cells, std::size_t entry) {
  const auto at = [&](std::uint64_t k) { return cells.neighbor.begin() + static_cast<std::ptrdiff_t>(k); };
  std::vector<std::int32_t> row(at(cells.offsets[entry]), at(cells.offsets[entry + 1]));
  std::ranges::sort(row);
  return row;
}

// Expects the same sets of neighbors wherever the statuses are the same; returns how many are not.
std::size_t differingStatuses(const CellNeighbors& a, const CellNeighbors& b) {
  EXPECT_EQ(a.status.size(), b.status.size());
  std::size_t count = 0;
  for (std::size_t entry = 0; entry < a.status.size(); entry++) {
    if (a.status[entry] != b.status[entry]) {
      count++;
    } else {
      EXPECT_EQ(sortedRow(a, entry), sortedRow(b, entry)) << "entry " << entry;
    }
  }
  return count;
}

// A site within rounding of the side of its bin may stand in another one, so that a search tries one site
// more before it gives up: 4 of 30,000 clustered cells. Nothing else may differ.
TEST_P(OfSites, GiveTheSameCells) {
  // The second set is the smaller one, and the third needs more room than both.
  for (const std::size_t count : {6000U, 50U, 30000U}) {
    const SiteSet set = prepared(generate(GetParam(), count, 3));
    ASSERT_TRUE(host_->upload(set, {}).has_value());
    ASSERT_TRUE(device_->upload(set, {}).has_value());
    for (const Capacity capacity : {Capacity::small, Capacity::large}) {
      CellNeighbors by_host;
      CellNeighbors by_device;
      const auto all = range(0, set.size());
      ASSERT_TRUE(host_->cells(all, capacity, by_host).has_value());
      ASSERT_TRUE(device_->cells(all, capacity, by_device).has_value());
      EXPECT_GT(std::ranges::count(by_device.status, CellStatus::certified), std::ssize(set.x) / 2);
      EXPECT_LE(differingStatuses(by_host, by_device), set.size() / 5000);
    }
  }
  expectSilence();
}

TEST_P(OfSites, GiveTheSamePicture) {
  const SiteSet set = prepared(generate(GetParam(), 6000, 4));
  std::vector<std::uint8_t> palette_index;
  for (const std::uint32_t id : set.id) palette_index.push_back(static_cast<std::uint8_t>(id % 251));
  const View view = makeView(300, 200);
  std::vector<Image> pictures;
  std::vector<std::vector<CellStatus>> statuses;
  for (Backend* backend : {host_.get(), device_.get()}) {
    ASSERT_TRUE(backend->upload(set, palette_index).has_value());
    ASSERT_TRUE(backend->begin(view).has_value());
    std::vector<CellStatus> status(set.size());
    ASSERT_TRUE(backend->draw(range(0, set.size()), Capacity::large, status).has_value());
    pictures.push_back(read(*backend, view));
    statuses.push_back(std::move(status));
  }
  EXPECT_EQ(statuses[0], statuses[1]);
  EXPECT_EQ(pictures[0].ids, pictures[1].ids);
  EXPECT_EQ(pictures[0].rgba, pictures[1].rgba);
  expectSilence();
}

INSTANTIATE_TEST_SUITE_P(Compute, OfSites,
                         testing::Values(Pattern::random, Pattern::clusters, Pattern::hex, Pattern::jitter));

// To draw lists with more room replaces buffers that the search for cells has bound.
TEST(ComputeBackend, FindsCellsAfterDrawingLists) {
  const auto backend = openBackend({}, 0);
  ASSERT_TRUE(backend);
  const Scene scene = makeScene(200);
  ASSERT_TRUE(backend->upload(scene.set, scene.palette_index).has_value());
  CellNeighbors before;
  ASSERT_TRUE(backend->cells(range(0, 200), Capacity::large, before).has_value());
  ASSERT_TRUE(backend->begin(makeView(64, 64)).has_value());
  drawSites(*backend, range(0, 200), Capacity::small);
  drawLists(*backend, scene, range(0, 200), Capacity::large);
  CellNeighbors after;
  ASSERT_TRUE(backend->cells(range(0, 200), Capacity::large, after).has_value());
  EXPECT_EQ(before.status, after.status);
  EXPECT_EQ(before.neighbor, after.neighbor);
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

TEST(ComputeBackend, TakesItsSitesFromTheStorageRangeWhereTheDevicePlacesThem) {
  const auto backend = openSortedBy(SiteSorter::device, {{}, {{"maxStorageBufferRange", 4096}}});
  ASSERT_TRUE(backend);
  EXPECT_EQ(backend->info().max_sites, 256U);
  EXPECT_EQ(backend->info().max_bins, 1023U);
  EXPECT_EQ(backend->info().max_entries, 128U);
  const SiteSet set = prepared(generate(Pattern::random, 256, 7));
  ASSERT_TRUE(backend->upload(set, {}).has_value());
  CellNeighbors cells;
  ASSERT_TRUE(backend->cells(range(0, 128), Capacity::large, cells).has_value());
  EXPECT_EQ(cells.status, std::vector(128, CellStatus::certified));
  EXPECT_EQ(backend->validationMessages(), std::vector<std::string>());
}

}  // namespace
}  // namespace vorpipe::test
