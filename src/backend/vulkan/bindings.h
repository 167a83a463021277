/// What the shaders read and write besides vertices: one descriptor set, laid out by layout.glsl.
#pragma once

#include <volk.h>

#include <cstdint>
#include <span>

#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
#include "layout.glsl"

namespace vorpipe::vulkan {

class Bindings {
 public:
  /// The bindings of the geometry pipelines.
  static Result<Bindings> create(const Device& device);
  /// The given bindings, with push_bytes of push constants for compute shaders, unless that is 0.
  static Result<Bindings> create(const Device& device, std::span<const VkDescriptorSetLayoutBinding> bindings,
                                 std::uint32_t push_bytes);

  // The device must not be using the set.
  void setUniform(const Device& device, std::uint32_t binding, VkBuffer buffer);
  void setTexels(const Device& device, std::uint32_t binding, VkBufferView texels);
  void setStorage(const Device& device, std::uint32_t binding, VkBuffer buffer, VkDeviceSize bytes);
  /// An image that is in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL when it is read.
  void setSampled(const Device& device, std::uint32_t binding, VkSampler sampler, VkImageView image);

  [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }
  [[nodiscard]] VkDescriptorSet set() const { return set_; }

 private:
  Bindings() = default;
  Result<void> allocateSet(const Device& device, std::span<const VkDescriptorSetLayoutBinding> bindings);

  Handle<VkDescriptorSetLayout> set_layout_;
  Handle<VkPipelineLayout> layout_;
  Handle<VkDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace vorpipe::vulkan
