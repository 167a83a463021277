#include "backend/vulkan/plane.h"

#include <utility>
#include <vector>

#include "backend/vulkan/buffer.h"
#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"

namespace vorpipe::vulkan {

Result<Plane> createPlane(const Device& device, const PlaneKind& kind, VkExtent2D extent) {
  const VolkDeviceTable& api = device.api();
  auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = kind.format;
  info.extent = {extent.width, extent.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = kind.usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  VORPIPE_VAR(image, create(device.handle(), api.vkCreateImage, api.vkDestroyImage, info, "vkCreateImage"));
  VkMemoryRequirements needed{};
  api.vkGetImageMemoryRequirements(device.handle(), image.get(), &needed);
  VORPIPE_VAR(memory, allocate(device, needed, Placement::device, "an image"));
  Plane plane;
  plane.memory = std::move(memory);
  plane.image = std::move(image);
  VORPIPE_TRY(check(api.vkBindImageMemory(device.handle(), plane.image.get(), plane.memory.get(), 0),
                    "vkBindImageMemory"));
  auto view_info = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view_info.image = plane.image.get();
  view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view_info.format = kind.format;
  view_info.components = kind.components;
  view_info.subresourceRange = whole_plane;
  VORPIPE_VAR(view, create(device.handle(), api.vkCreateImageView, api.vkDestroyImageView, view_info,
                           "vkCreateImageView"));
  plane.view = std::move(view);
  return plane;
}

void change(const VolkDeviceTable& api, VkCommandBuffer commands, std::span<const VkImage> images,
            const Use& from, const Use& to) {
  std::vector<VkImageMemoryBarrier> barriers;
  for (const VkImage image : images) {
    auto barrier = structure<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    barrier.srcAccessMask = from.access;
    barrier.dstAccessMask = to.access;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = whole_plane;
    barriers.push_back(barrier);
  }
  api.vkCmdPipelineBarrier(commands, from.stage, to.stage, 0, 0, nullptr, 0, nullptr,
                           static_cast<std::uint32_t>(barriers.size()), barriers.data());
}

}  // namespace vorpipe::vulkan
