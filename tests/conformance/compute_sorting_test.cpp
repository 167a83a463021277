// The sites of an upload in the bins that the device made, compared with what bins are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "backend/site_texels.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
#include "backend/vulkan/instance.h"
#include "backend/vulkan/physical.h"
#include "backend/vulkan/sorted_sites.h"
#include "backend_scene.h"

namespace vorpipe::vulkan {
namespace {

// What a search binds of the sites.
constexpr VkShaderStageFlags compute = VK_SHADER_STAGE_COMPUTE_BIT;
constexpr VkDescriptorType texels = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
constexpr std::array<VkDescriptorSetLayoutBinding, 6> search_bindings = {{
    {BINDING_GRID, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, compute, nullptr},
    {BINDING_SITES, texels, 1, compute, nullptr},
    {BINDING_BINS, texels, 1, compute, nullptr},
    {BINDING_MARKS, texels, 1, compute, nullptr},
    {BINDING_RANK_OF_SITE, texels, 1, compute, nullptr},
    {BINDING_SITE_OF_RANK, texels, 1, compute, nullptr},
}};

constexpr std::size_t most = 1 << 20;

class ComputeSorting : public testing::Test {
 protected:
  void SetUp() override {
    Result<Instance> instance = Instance::open(true);
    ASSERT_TRUE(instance.has_value()) << instance.error().message;
    instance_ = std::make_unique<Instance>(std::move(*instance));
    const auto devices = enumerate(*instance_, {}, Pipeline::compute);
    ASSERT_TRUE(devices.has_value()) << devices.error().message;
    const Result<Physical> physical = choose(*devices, "");
    ASSERT_TRUE(physical.has_value()) << physical.error().message;
    Result<Device> device = Device::open(*physical);
    ASSERT_TRUE(device.has_value()) << device.error().message;
    device_ = std::make_unique<Device>(std::move(*device));
    Result<SortedSites> sorted = SortedSites::create(*device_);
    ASSERT_TRUE(sorted.has_value()) << sorted.error().message;
    sorted_ = std::make_unique<SortedSites>(std::move(*sorted));
    Result<Bindings> search = Bindings::create(*device_, search_bindings, 0);
    ASSERT_TRUE(search.has_value()) << search.error().message;
    search_ = std::make_unique<Bindings>(std::move(*search));
  }

  void TearDown() override { EXPECT_EQ(instance_->messages().take(), std::vector<std::string>()); }

  std::vector<std::uint32_t> readBack(VkBuffer buffer, std::size_t count) {
    const std::size_t bytes = count * sizeof(std::uint32_t);
    Buffer host({"a copy", VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::download});
    EXPECT_TRUE(host.reserve(*device_, bytes, bytes).has_value());
    const Result<void> done = device_->run([&](VkCommandBuffer commands) {
      auto order = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
      order.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
      order.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
      device_->api().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                          VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &order, 0, nullptr, 0,
                                          nullptr);
      const VkBufferCopy all{0, 0, bytes};
      device_->api().vkCmdCopyBuffer(commands, buffer, host.get(), 1, &all);
    });
    EXPECT_TRUE(done.has_value());
    std::vector<std::uint32_t> numbers(count);
    std::memcpy(numbers.data(), host.data(), bytes);
    return numbers;
  }

  // Expects each bin to hold the sites that lie in it, in the order of their indices.
  void expectBins(const SiteSet& set) {
    BackendInfo limits;
    limits.max_sites = limits.max_bins = most;
    const Result<void> done = sorted_->upload(*device_, *search_, set, {}, limits);
    ASSERT_TRUE(done.has_value()) << done.error().message;
    const Grid& grid = set.grid;
    const auto starts = readBack(sorted_->starts(), std::size_t{grid.columns} * grid.rows + 1);
    const auto site_at = readBack(sorted_->siteOfRank(), set.size());
    const auto rank_of = readBack(sorted_->rankOfSite(), set.size());
    ASSERT_EQ(starts.front(), 0U);
    ASSERT_EQ(starts.back(), set.size());
    ASSERT_TRUE(std::ranges::is_sorted(starts));
    std::vector<bool> seen(set.size());
    for (std::size_t bin = 0; bin + 1 < starts.size(); bin++) {
      for (std::uint32_t rank = starts[bin]; rank < starts[bin + 1]; rank++) {
        const std::uint32_t site = site_at[rank];
        ASSERT_LT(site, set.size());
        ASSERT_FALSE(seen[site]);
        seen[site] = true;
        ASSERT_EQ(rank_of[site], rank);
        ASSERT_TRUE(rank == starts[bin] || site_at[rank - 1] < site) << "bin " << bin;
        expectInside(set, site, bin);
      }
    }
  }

 private:
  // The outermost bins take what lies outside of the grid.
  static void expectInside(const SiteSet& set, std::uint32_t site, std::size_t bin) {
    const Grid& grid = set.grid;
    const double slack = siteGridUniform(set).slack;
    const auto along = [&](double at, std::size_t index, std::uint32_t count) {
      const double low = static_cast<double>(index) * grid.size - slack;
      const double high = static_cast<double>(index + 1) * grid.size + slack;
      return (at >= low || index == 0) && (at <= high || index + 1 == count);
    };
    ASSERT_TRUE(along(set.x[site] - grid.xmin, bin % grid.columns, grid.columns)) << "site " << site;
    ASSERT_TRUE(along(set.y[site] - grid.ymin, bin / grid.columns, grid.rows)) << "site " << site;
  }

  std::unique_ptr<Instance> instance_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<SortedSites> sorted_;
  std::unique_ptr<Bindings> search_;
};

// The sites of a set in an order that has nothing to do with the grid.
SiteSet shuffled(const SiteSet& set) {
  std::vector<std::uint32_t> order = test::range(0, set.size());
  std::mt19937_64 random(11);
  std::ranges::shuffle(order, random);
  SiteSet other = set;
  for (std::size_t k = 0; k < order.size(); k++) {
    other.x[k] = set.x[order[k]];
    other.y[k] = set.y[order[k]];
    other.id[k] = set.id[order[k]];
  }
  return other;
}

TEST_F(ComputeSorting, PutsEachSiteIntoItsBinInOrder) {
  for (const Pattern pattern : {Pattern::random, Pattern::square, Pattern::hex, Pattern::clusters}) {
    for (const std::size_t count : {1U, 2U, 100U, 9000U}) {
      const SiteSet set = test::prepared(generate(pattern, count, 5));
      expectBins(set);
      expectBins(shuffled(set));
    }
  }
}

// Bins of as many sites as one run has, or as many as it takes another merge for, and around these.
TEST_F(ComputeSorting, OrdersCrowdedBins) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> inside(0, 1);
  for (const std::size_t crowd : {31U, 32U, 33U, 64U, 65U, 128U, 129U, 512U, 2049U, 70001U}) {
    Sites sites = generate(Pattern::random, 200, 6);
    for (std::size_t k = 0; k < crowd; k++) {
      sites.x.push_back(0.51 + 1e-6 * inside(random));
      sites.y.push_back(0.49 + 1e-6 * inside(random));
    }
    SiteSet set = test::prepared(sites);
    // One bin takes the crowd.
    set.grid = {0, 0, 1.0 / 16, 16, 16, {}};
    expectBins(shuffled(set));
  }
}

TEST_F(ComputeSorting, TakesSitesOutsideTheGrid) {
  Sites sites = generate(Pattern::random, 3000, 7);
  for (double& x : sites.x) x = 5 * x - 2;
  SiteSet set = test::prepared(sites);
  set.grid = {0, 0, 1.0 / 16, 16, 16, {}};
  expectBins(set);
}

}  // namespace
}  // namespace vorpipe::vulkan
