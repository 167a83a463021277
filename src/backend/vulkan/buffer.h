/// A buffer that grows when more is requested than it holds.
#pragma once

#include <volk.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"

namespace vorpipe::vulkan {

enum class Placement : std::uint8_t {
  device,    ///< only the device uses it
  upload,    ///< the host writes, the device reads: in the device's own memory where that can be mapped
  download,  ///< the device writes, the host reads: in the host's cached memory if there is any
};

/// Allocates memory for `what` (a word for the message) in the best heap that has room for it.
/// upload and download memory can be mapped and is coherent.
Result<Handle<VkDeviceMemory>> allocate(const Device& device, const VkMemoryRequirements& needed,
                                        Placement placement, std::string_view what);

class Buffer {
 public:
  struct Kind {
    std::string_view what;  ///< for messages
    VkBufferUsageFlags usage;
    Placement placement;
    VkFormat texel = VK_FORMAT_UNDEFINED;  ///< of the texel view; undefined: the buffer has none
  };

  explicit Buffer(const Kind& kind) : kind_(kind) {}

  /// Makes room for `bytes`, at most `limit`. The contents are lost if it has to grow. It grows by at least
  /// half, up to limit. The device must not be using it.
  Result<void> reserve(const Device& device, std::size_t bytes, std::size_t limit);

  [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
  [[nodiscard]] VkBufferView texels() const { return texels_.get(); }
  /// The mapped bytes; null for Placement::device.
  [[nodiscard]] std::byte* data() const { return data_; }

 private:
  void drop();
  Result<void> allocateBytes(const Device& device, std::size_t bytes);

  Kind kind_;
  std::size_t size_ = 0;
  std::byte* data_ = nullptr;
  // In this order, so that the view goes before the buffer and the buffer before its memory.
  Handle<VkDeviceMemory> memory_;
  Handle<VkBuffer> buffer_;
  Handle<VkBufferView> texels_;
};

}  // namespace vorpipe::vulkan
