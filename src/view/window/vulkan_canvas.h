/// The image in which Vulkan composes a frame: the picture, and triangles over it.
#pragma once

#include <cstdint>
#include <optional>

#include "backend/vulkan/bindings.h"
#include "backend/vulkan/buffer.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
#include "backend/vulkan/plane.h"
#include "view/window/frame_parts.h"
#include "view/window/presenter.h"

namespace vorpipe::view {

class VulkanCanvas {
 public:
  static Result<VulkanCanvas> create(const vulkan::Device& device);

  Result<void> setTexture(vulkan::Device& device, const PanelTexture& texture);

  /// Stores what the next record() needs of a frame, for a window of `width` x `height` pixels. The device
  /// must not be using the canvas.
  Result<void> prepare(const vulkan::Device& device, const Shown& frame, int width, int height);
  /// Records the drawing commands, which leave image() in the state vulkan::copied.
  void record(const VolkDeviceTable& api, VkCommandBuffer commands) const;
  /// Call when the commands of record() are done.
  void recorded();

  [[nodiscard]] VkImage image() const { return canvas_.image.get(); }
  [[nodiscard]] VkExtent2D extent() const { return extent_; }
  Result<Image> read(vulkan::Device& device);

 private:
  VulkanCanvas(vulkan::Bindings picture_bindings, vulkan::Bindings panel_bindings)
      : picture_bindings_(std::move(picture_bindings)), panel_bindings_(std::move(panel_bindings)) {}
  Result<void> resize(const vulkan::Device& device, VkExtent2D extent);
  Result<void> takePicture(const vulkan::Device& device, const Shown& frame);
  void recordPicture(const VolkDeviceTable& api, VkCommandBuffer commands) const;
  void recordTriangles(const VolkDeviceTable& api, VkCommandBuffer commands) const;

  vulkan::Handle<VkRenderPass> pass_;
  vulkan::Handle<VkSampler> sampler_;
  vulkan::Bindings picture_bindings_, panel_bindings_;
  vulkan::Handle<VkPipeline> pipeline_;

  VkExtent2D extent_{};
  vulkan::Plane canvas_;
  vulkan::Handle<VkFramebuffer> framebuffer_;
  vulkan::Plane panel_texture_;

  // The picture lies in `pixels_`. If sharp, it is copied from there; else it is drawn from the texture,
  // which is filled when needed.
  std::optional<std::uint64_t> version_, texture_version_;  ///< of the picture in each
  VkExtent2D picture_extent_{}, texture_extent_{};
  vulkan::Plane picture_texture_;
  bool sharp_ = false, drawn_ = false;
  FrameTriangles triangles_;

  vulkan::Buffer pixels_{{"the picture", VK_BUFFER_USAGE_TRANSFER_SRC_BIT, vulkan::Placement::upload}};
  vulkan::Buffer vertices_{
      {"triangles of the panel", VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, vulkan::Placement::upload}};
  vulkan::Buffer indices_{
      {"triangles of the panel", VK_BUFFER_USAGE_INDEX_BUFFER_BIT, vulkan::Placement::upload}};
  vulkan::Buffer host_{
      {"what the window shows", VK_BUFFER_USAGE_TRANSFER_DST_BIT, vulkan::Placement::download}};
};

}  // namespace vorpipe::view
