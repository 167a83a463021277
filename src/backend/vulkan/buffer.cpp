#include "backend/vulkan/buffer.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "backend/vulkan/error.h"
#include "backend/vulkan/structure.h"

namespace vorpipe::vulkan {

Result<void> Buffer::reserve(const Device& device, std::size_t bytes, std::size_t limit) {
  assert(bytes <= limit);
  if (bytes <= size_ && size_ > 0) return {};
  const std::size_t grown = std::min(limit, std::max<std::size_t>({bytes, size_ + size_ / 2, 4096}));
  drop();
  Result<void> allocated = allocateBytes(device, grown);
  if (!allocated && allocated.error().out_of_memory && grown > bytes && bytes > 0) {
    // Room to grow is optional.
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
  Result<Handle<VkBuffer>> buffer = create(device.handle(), api.vkCreateBuffer, api.vkDestroyBuffer, info,
                                           "vkCreateBuffer for " + std::string(kind_.what));
  if (!buffer) return tl::unexpected(std::move(buffer).error());
  VkMemoryRequirements needed{};
  api.vkGetBufferMemoryRequirements(device.handle(), buffer->get(), &needed);
  Result<Handle<VkDeviceMemory>> memory = allocate(device, needed, kind_.placement, kind_.what);
  if (!memory) return tl::unexpected(std::move(memory).error());
  memory_ = std::move(*memory);
  buffer_ = std::move(*buffer);
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
  Result<Handle<VkBufferView>> texels =
      create(device.handle(), api.vkCreateBufferView, api.vkDestroyBufferView, view, "vkCreateBufferView");
  if (!texels) return tl::unexpected(std::move(texels).error());
  texels_ = std::move(*texels);
  return {};
}

}  // namespace vorpipe::vulkan
