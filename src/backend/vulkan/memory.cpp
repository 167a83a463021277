#include "backend/vulkan/memory.h"

#include <array>
#include <string>

#include "backend/vulkan/error.h"
#include "backend/vulkan/structure.h"

namespace vorpipe::vulkan {
namespace {

// What to ask of the memory, first choice first.
std::array<VkMemoryPropertyFlags, 2> wishes(Placement placement) {
  constexpr VkMemoryPropertyFlags mapped =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (placement) {
    case Placement::upload:
      return {mapped | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, mapped};
    case Placement::download:
      return {mapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, mapped};
    case Placement::device:
      break;
  }
  return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
}

}  // namespace

Result<Handle<VkDeviceMemory>> allocate(const Device& device, const VkMemoryRequirements& needed,
                                        Placement placement, std::string_view what) {
  const VkPhysicalDeviceMemoryProperties& memory = device.memory();
  VkResult failure = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  std::uint32_t left = needed.size <= device.largestAllocation() ? needed.memoryTypeBits : 0;
  for (const VkMemoryPropertyFlags wish : wishes(placement)) {
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; type++) {
      const std::uint32_t bit = 1U << type;
      if ((left & bit) == 0 || (memory.memoryTypes[type].propertyFlags & wish) != wish) continue;
      left &= ~bit;
      auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
      info.allocationSize = needed.size;
      info.memoryTypeIndex = type;
      VkDeviceMemory object = VK_NULL_HANDLE;
      failure = device.api().vkAllocateMemory(device.handle(), &info, nullptr, &object);
      if (failure == VK_SUCCESS) {
        return Handle<VkDeviceMemory>(device.handle(), object, device.api().vkFreeMemory);
      }
      if (failure != VK_ERROR_OUT_OF_DEVICE_MEMORY) left = 0;
    }
  }
  const std::string call =
      "vkAllocateMemory of " + std::to_string(needed.size) + " bytes for " + std::string(what);
  return tl::unexpected(check(failure, call).error());
}

}  // namespace vorpipe::vulkan
