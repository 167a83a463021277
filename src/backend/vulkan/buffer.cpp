#include "backend/vulkan/buffer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"

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

Result<void> Buffer::reserve(const Device& device, std::size_t bytes, std::size_t limit) {
  assert(bytes <= limit);
  if (bytes <= size_ && size_ > 0) return {};
  const std::size_t grown = std::min(limit, std::max<std::size_t>({bytes, size_ + size_ / 2, 4096}));
  drop();
  Result<void> allocated = allocateBytes(device, grown);
  if (!allocated && allocated.error().out_of_memory && grown > bytes && bytes > 0) {
    // Memory beyond what was asked for is optional.
    drop();
    allocated = allocateBytes(device, bytes);
    if (allocated) size_ = bytes;
    return allocated;
  }
  if (allocated) size_ = grown;
  return allocated;
}

void Buffer::drop() {
  size_ = 0;
  data_ = nullptr;
  texels_ = {};
  buffer_ = {};
  memory_ = {};
}

Result<void> Buffer::allocateBytes(const Device& device, std::size_t bytes) {
  const VolkDeviceTable& api = device.api();
  auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = kind_.usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  VORPIPE_VAR(buffer, create(device.handle(), api.vkCreateBuffer, api.vkDestroyBuffer, info,
                             "vkCreateBuffer for " + std::string(kind_.what)));
  VkMemoryRequirements needed{};
  api.vkGetBufferMemoryRequirements(device.handle(), buffer.get(), &needed);
  VORPIPE_VAR(memory, allocate(device, needed, kind_.placement, kind_.what));
  memory_ = std::move(memory);
  buffer_ = std::move(buffer);
  VORPIPE_TRY(
      check(api.vkBindBufferMemory(device.handle(), buffer_.get(), memory_.get(), 0), "vkBindBufferMemory"));
  if (kind_.placement != Placement::device) {
    void* mapped = nullptr;
    VORPIPE_TRY(
        check(api.vkMapMemory(device.handle(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory"));
    data_ = static_cast<std::byte*>(mapped);
  }
  if (kind_.texel == VK_FORMAT_UNDEFINED) return {};
  auto view = structure<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
  view.buffer = buffer_.get();
  view.format = kind_.texel;
  view.range = VK_WHOLE_SIZE;
  VORPIPE_VAR(texels, create(device.handle(), api.vkCreateBufferView, api.vkDestroyBufferView, view,
                             "vkCreateBufferView"));
  texels_ = std::move(texels);
  return {};
}

}  // namespace vorpipe::vulkan
