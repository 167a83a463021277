#include "backend/vulkan/bindings.h"

#include <array>
#include <utility>

#include "backend/vulkan/error.h"
#include "backend/vulkan/structure.h"

namespace vorpipe::vulkan {
namespace {

constexpr std::array<VkDescriptorSetLayoutBinding, 5> layout_bindings = {{
    {BINDING_VIEW, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_LINES, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {BINDING_PALETTE, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr},
    {BINDING_STATUS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
    {binding_edges, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_GEOMETRY_BIT, nullptr},
}};

constexpr std::array<VkDescriptorPoolSize, 3> pool_sizes = {{
    {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
    {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 2},
    {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2},
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

Result<Bindings> Bindings::create(const Device& device) {
  const VolkDeviceTable& api = device.api();
  Bindings bindings;
  auto set_info =
      structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_info.bindingCount = static_cast<std::uint32_t>(layout_bindings.size());
  set_info.pBindings = layout_bindings.data();
  Result<Handle<VkDescriptorSetLayout>> set_layout =
      vulkan::create(device.handle(), api.vkCreateDescriptorSetLayout, api.vkDestroyDescriptorSetLayout,
                     set_info, "vkCreateDescriptorSetLayout");
  if (!set_layout) return tl::unexpected(std::move(set_layout).error());
  bindings.set_layout_ = std::move(*set_layout);
  const VkDescriptorSetLayout set_layout_object = bindings.set_layout_.get();
  auto layout_info = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &set_layout_object;
  Result<Handle<VkPipelineLayout>> layout =
      vulkan::create(device.handle(), api.vkCreatePipelineLayout, api.vkDestroyPipelineLayout, layout_info,
                     "vkCreatePipelineLayout");
  if (!layout) return tl::unexpected(std::move(layout).error());
  bindings.layout_ = std::move(*layout);
  auto pool_info = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = static_cast<std::uint32_t>(pool_sizes.size());
  pool_info.pPoolSizes = pool_sizes.data();
  Result<Handle<VkDescriptorPool>> pool =
      vulkan::create(device.handle(), api.vkCreateDescriptorPool, api.vkDestroyDescriptorPool, pool_info,
                     "vkCreateDescriptorPool");
  if (!pool) return tl::unexpected(std::move(pool).error());
  bindings.pool_ = std::move(*pool);
  auto allocate_info = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocate_info.descriptorPool = bindings.pool_.get();
  allocate_info.descriptorSetCount = 1;
  allocate_info.pSetLayouts = &set_layout_object;
  VORPIPE_TRY(check(api.vkAllocateDescriptorSets(device.handle(), &allocate_info, &bindings.set_),
                    "vkAllocateDescriptorSets"));
  return bindings;
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

void Bindings::setStorage(const Device& device, std::uint32_t binding, VkBuffer buffer, VkDeviceSize bytes) {
  const VkDescriptorBufferInfo part{buffer, 0, bytes};
  VkWriteDescriptorSet write = writeTo(set_, binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  write.pBufferInfo = &part;
  device.api().vkUpdateDescriptorSets(device.handle(), 1, &write, 0, nullptr);
}

}  // namespace vorpipe::vulkan
