// Which devices are given sites, and when: a batch may be clipped when the sites of the last upload are gone.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "backend/vulkan/device_pool.h"

namespace vorpipe::vulkan {
namespace {

/// Ids of the sites in each upload.
using Uploads = std::vector<std::vector<std::uint32_t>>;

/// Certifies what it is asked for by index if it has as many sites, and any batch.
class Device final : public Backend {
 public:
  explicit Device(Uploads& uploads) : uploads_(uploads) {}

  const BackendInfo& info() const override { return info_; }
  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t>) override {
    uploads_.push_back(sites.id);
    return {};
  }
  Result<void> cells(std::span<const std::uint32_t> which, Capacity, CellNeighbors& out) override {
    out.status.resize(which.size());
    std::transform(which.begin(), which.end(), out.status.begin(), [&](auto site) { return of(site); });
    out.offsets.assign(which.size() + 1, 0);
    return {};
  }
  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override {
    out.status.assign(batch.entries.size(), CellStatus::certified);
    out.offsets.assign(batch.entries.size() + 1, 0);
    return {};
  }
  Result<void> begin(const View&) override { return {}; }
  Result<void> draw(std::span<const std::uint32_t> which, Capacity, std::span<CellStatus> status) override {
    std::transform(which.begin(), which.end(), status.begin(), [&](auto site) { return of(site); });
    return {};
  }
  Result<void> draw(const CellBatch<float>&, std::span<const DrawMark>, Capacity,
                    std::span<CellStatus> status) override {
    std::fill(status.begin(), status.end(), CellStatus::certified);
    return {};
  }
  Result<void> read(std::span<std::uint32_t>, std::span<std::uint32_t>) override { return {}; }
  Result<void> drawTriangles(std::span<const DrawMark>, std::span<const std::uint32_t>) override {
    return {};
  }
  Result<void> compute(std::span<const Operands>, std::span<Computed>) override { return {}; }

 private:
  [[nodiscard]] CellStatus of(std::uint32_t site) const {
    const bool known = !uploads_.empty() && site < uploads_.back().size();
    return known ? CellStatus::certified : CellStatus::missing;
  }

  Uploads& uploads_;
  BackendInfo info_;
};

class DevicePoolTest : public ::testing::Test {
 protected:
  static constexpr std::size_t enough_for_two = std::size_t{1} << 15;

  static SiteSet sitesFrom(std::uint32_t first_id) {
    SiteSet sites;
    sites.id.resize(enough_for_two);
    std::iota(sites.id.begin(), sites.id.end(), first_id);
    sites.x.resize(enough_for_two);
    sites.y.resize(enough_for_two);
    return sites;
  }
  void drawBatch() {
    CellBatch<float> batch;
    batch.entries.resize(enough_for_two);
    std::vector<CellStatus> status(enough_for_two);
    const std::vector<DrawMark> marks(enough_for_two);
    ASSERT_TRUE(devices->draw(batch, marks, Capacity::large, status));
  }

  Uploads first, second;
  std::unique_ptr<Backend> devices = makeDevicePool(
      std::make_unique<Device>(first),
      [this]() -> Result<std::unique_ptr<Backend>> { return std::make_unique<Device>(second); }, 2);
};

TEST_F(DevicePoolTest, BatchesNeedNoSites) {
  {
    const auto tile = std::make_unique<SiteSet>(sitesFrom(0));
    ASSERT_TRUE(devices->upload(*tile, {}));
  }
  drawBatch();
  EXPECT_EQ(first.size(), 1u);
  EXPECT_TRUE(second.empty());
}

TEST_F(DevicePoolTest, EachHasTheSitesOfTheLastUploadWhenAsked) {
  drawBatch();
  std::vector<std::uint32_t> which(enough_for_two);
  std::iota(which.begin(), which.end(), 0u);
  const std::vector<CellStatus> all_certified(enough_for_two, CellStatus::certified);
  for (const std::uint32_t first_id : {0u, 70'000u}) {
    const auto sites = sitesFrom(first_id);
    ASSERT_TRUE(devices->upload(sites, {}));
    CellNeighbors found;
    ASSERT_TRUE(devices->cells(which, Capacity::small, found));
    EXPECT_EQ(found.status, all_certified);
    std::vector<CellStatus> status(enough_for_two);
    ASSERT_TRUE(devices->draw(which, Capacity::small, status));
    EXPECT_EQ(status, all_certified);
    EXPECT_EQ(first.back().front(), first_id);
    EXPECT_EQ(second.back().front(), first_id);
  }
  EXPECT_EQ(second.size(), 2u) << "sites are given once";
}

}  // namespace
}  // namespace vorpipe::vulkan
