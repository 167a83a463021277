/// What the shaders read and write besides vertices: one descriptor set, laid out by layout.glsl.
#pragma once

#include <volk.h>

#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
#include "layout.glsl"

namespace vorpipe::vulkan {

/// Of edges.geom alone, after those of layout.glsl.
inline constexpr std::uint32_t binding_edges = BINDING_STATUS + 1;

class Bindings {
 public:
  static Result<Bindings> create(const Device& device);

  // The device must not be using the set.
  void setUniform(const Device& device, std::uint32_t binding, VkBuffer buffer);
  void setTexels(const Device& device, std::uint32_t binding, VkBufferView texels);
  void setStorage(const Device& device, std::uint32_t binding, VkBuffer buffer, VkDeviceSize bytes);

  [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }
  [[nodiscard]] VkDescriptorSet set() const { return set_; }

 private:
  Bindings() = default;

  Handle<VkDescriptorSetLayout> set_layout_;
  Handle<VkPipelineLayout> layout_;
  Handle<VkDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace vorpipe::vulkan
