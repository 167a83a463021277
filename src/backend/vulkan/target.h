/// The picture: a color image, an id image, and their transfer to the host.
#pragma once

#include <volk.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "backend/vulkan/buffer.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
#include "backend/vulkan/plane.h"

namespace vorpipe::vulkan {

inline constexpr VkFormat color_format = VK_FORMAT_R8G8B8A8_UNORM;
inline constexpr VkFormat id_format = VK_FORMAT_R32_UINT;

/// What a Target has: color is attachment 0, id is attachment 1.
inline constexpr std::array target_formats = {color_format, id_format};

/// Draws onto planes of these formats, in the layout of `drawn`; they keep what is there.
Result<Handle<VkRenderPass>> createRenderPass(const Device& device, std::span<const VkFormat> formats);

class Target {
 public:
  /// Replaces the images unless they have this size already.
  Result<void> resize(const Device& device, VkRenderPass pass, std::uint32_t width, std::uint32_t height);
  /// Sets color 0 and no_site everywhere.
  Result<void> clear(Device& device) const;
  /// Rows as they lie in memory. Both spans hold width * height.
  Result<void> read(Device& device, std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids);

  [[nodiscard]] VkExtent2D extent() const { return extent_; }
  [[nodiscard]] VkFramebuffer framebuffer() const { return framebuffer_.get(); }

 private:
  Result<void> readPlane(Device& device, const Plane& plane, std::span<std::uint32_t> to);
  [[nodiscard]] std::size_t planeBytes() const;

  VkExtent2D extent_{0, 0};
  Plane color_, id_;
  Handle<VkFramebuffer> framebuffer_;
  Buffer host_{{"the picture", VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::download}};  ///< a plane
};

}  // namespace vorpipe::vulkan
