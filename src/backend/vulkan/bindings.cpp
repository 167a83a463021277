#include "backend/vulkan/bindings.h"

#include <array>
#include <utility>
#include <vector>

#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"

namespace vorpipe::vulkan {
namespace {

constexpr std::array<VkDescriptorSetLayoutBinding, 11> layout_bindings = {{
    {BINDING_VIEW, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_LINES, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_PALETTE, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr},
    {BINDING_STATUS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_EDGES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_GRID, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_SITES, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_BINS, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_MARKS, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_WEIGHTS, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_HEAVIEST, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
}};

VkWriteDescriptorSet writeTo(VkDescriptorSet set, std::uint32_t binding, VkDescriptorType type) {
  auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
  write.dstSet = set;
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = type;
  return write;
}

}  // namespace

Result<Bindings> Bindings::create(const Device& device) { return create(device, layout_bindings, 0); }

Result<Bindings> Bindings::create(const Device& device,
                                  std::span<const VkDescriptorSetLayoutBinding> bindings,
                                  std::uint32_t push_bytes) {
  const VolkDeviceTable& api = device.api();
  Bindings created;
  auto set_info =
      structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  set_info.pBindings = bindings.data();
  VORPIPE_VAR(set_layout,
              vulkan::create(device.handle(), api.vkCreateDescriptorSetLayout,
                             api.vkDestroyDescriptorSetLayout, set_info, "vkCreateDescriptorSetLayout"));
  created.set_layout_ = std::move(set_layout);
  const VkDescriptorSetLayout set_layout_object = created.set_layout_.get();
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
  auto layout_info = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &set_layout_object;
  layout_info.pushConstantRangeCount = push_bytes > 0 ? 1 : 0;
  layout_info.pPushConstantRanges = &push;
  VORPIPE_VAR(layout, vulkan::create(device.handle(), api.vkCreatePipelineLayout, api.vkDestroyPipelineLayout,
                                     layout_info, "vkCreatePipelineLayout"));
  created.layout_ = std::move(layout);
  VORPIPE_TRY(created.allocateSet(device, bindings));
  return created;
}

Result<void> Bindings::allocateSet(const Device& device,
                                   std::span<const VkDescriptorSetLayoutBinding> bindings) {
  const VolkDeviceTable& api = device.api();
  std::vector<VkDescriptorPoolSize> sizes;
  for (const VkDescriptorSetLayoutBinding& binding : bindings) {
    sizes.push_back({binding.descriptorType, binding.descriptorCount});
  }
  auto pool_info = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  pool_info.pPoolSizes = sizes.data();
  VORPIPE_VAR(pool, vulkan::create(device.handle(), api.vkCreateDescriptorPool, api.vkDestroyDescriptorPool,
                                   pool_info, "vkCreateDescriptorPool"));
  pool_ = std::move(pool);
  const VkDescriptorSetLayout set_layout = set_layout_.get();
  auto info = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  info.descriptorPool = pool_.get();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &set_layout;
  return check(api.vkAllocateDescriptorSets(device.handle(), &info, &set_), "vkAllocateDescriptorSets");
}

void Bindings::setUniform(const Device& device, std::uint32_t binding, VkBuffer buffer) {
  const VkDescriptorBufferInfo whole{buffer, 0, VK_WHOLE_SIZE};
  VkWriteDescriptorSet write = writeTo(set_, binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
  write.pBufferInfo = &whole;
  device.api().vkUpdateDescriptorSets(device.handle(), 1, &write, 0, nullptr);
}

void Bindings::setTexels(const Device& device, std::uint32_t binding, VkBufferView texels) {
  VkWriteDescriptorSet write = writeTo(set_, binding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
  write.pTexelBufferView = &texels;
  device.api().vkUpdateDescriptorSets(device.handle(), 1, &write, 0, nullptr);
}

void Bindings::setSampled(const Device& device, std::uint32_t binding, VkSampler sampler, VkImageView image) {
  const VkDescriptorImageInfo sampled{sampler, image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  VkWriteDescriptorSet write = writeTo(set_, binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
  write.pImageInfo = &sampled;
  device.api().vkUpdateDescriptorSets(device.handle(), 1, &write, 0, nullptr);
}

void Bindings::setStorage(const Device& device, std::uint32_t binding, VkBuffer buffer, VkDeviceSize bytes) {
  const VkDescriptorBufferInfo part{buffer, 0, bytes};
  VkWriteDescriptorSet write = writeTo(set_, binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  write.pBufferInfo = &part;
  device.api().vkUpdateDescriptorSets(device.handle(), 1, &write, 0, nullptr);
}

}  // namespace vorpipe::vulkan
