#include "backend/vulkan/clock.h"

#include <array>
#include <vector>

#include "backend/vulkan/error.h"
#include "backend/vulkan/structure.h"

namespace vorpipe::vulkan {
namespace {

constexpr std::uint32_t ends = 2;
constexpr std::uint32_t word_bits = 64;
constexpr double seconds_per_nanosecond = 1e-9;

}  // namespace

Result<Clock> Clock::create(const Physical& physical, VkDevice device, const VolkDeviceTable& api) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical.handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical.handle, &count, families.data());
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical.handle, &properties);
  const std::uint32_t bits = families.at(physical.queue_family).timestampValidBits;
  Clock clock;
  if (bits == 0) return clock;
  clock.valid_ = bits >= word_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  clock.seconds_per_tick_ = seconds_per_nanosecond * static_cast<double>(properties.limits.timestampPeriod);
  auto info = structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = ends;
  Result<Handle<VkQueryPool>> pool =
      vulkan::create(device, api.vkCreateQueryPool, api.vkDestroyQueryPool, info, "vkCreateQueryPool");
  if (!pool) return tl::unexpected(std::move(pool).error());
  clock.pool_ = std::move(*pool);
  return clock;
}

void Clock::begin(const VolkDeviceTable& api, VkCommandBuffer commands) const {
  if (!pool_) return;
  api.vkCmdResetQueryPool(commands, pool_.get(), 0, ends);
  api.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, pool_.get(), 0);
}

void Clock::end(const VolkDeviceTable& api, VkCommandBuffer commands) const {
  if (pool_) api.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_.get(), 1);
}

Result<void> Clock::take(VkDevice device, const VolkDeviceTable& api) {
  if (!pool_) return {};
  std::array<std::uint64_t, ends> ticks{};
  VORPIPE_TRY(
      check(api.vkGetQueryPoolResults(device, pool_.get(), 0, ends, sizeof(ticks), ticks.data(),
                                      sizeof(ticks[0]), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
            "vkGetQueryPoolResults"));
  seconds_ += static_cast<double>((ticks[1] - ticks[0]) & valid_) * seconds_per_tick_;
  return {};
}

}  // namespace vorpipe::vulkan
