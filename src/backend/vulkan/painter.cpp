#include "backend/vulkan/painter.h"

#include <array>
#include <cassert>
#include <cstring>
#include <utility>

#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "backend/vulkan/triangle_pipeline.h"
#include "base/try.h"
#include "shaders.h"

namespace vorpipe::vulkan {
namespace {

constexpr std::array<VkDescriptorSetLayoutBinding, 1> paint_bindings = {{
    {BINDING_PALETTE, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr},
}};

static_assert(sizeof(DrawMark) == vertex_bytes && offsetof(DrawMark, y) == sizeof(float) &&
              offsetof(DrawMark, id) == 2 * sizeof(float) &&
              offsetof(DrawMark, palette_index) == 3 * sizeof(float));
constexpr VkVertexInputBindingDescription vertices{0, vertex_bytes, VK_VERTEX_INPUT_RATE_VERTEX};
constexpr std::array<VkVertexInputAttributeDescription, 2> attributes = {{
    {0, 0, VK_FORMAT_R32G32_SFLOAT, 0},
    {1, 0, VK_FORMAT_R32G32_UINT, 2 * sizeof(float)},
}};

constexpr VkPipelineColorBlendAttachmentState write_all{VK_FALSE,
                                                        VK_BLEND_FACTOR_ZERO,
                                                        VK_BLEND_FACTOR_ZERO,
                                                        VK_BLEND_OP_ADD,
                                                        VK_BLEND_FACTOR_ZERO,
                                                        VK_BLEND_FACTOR_ZERO,
                                                        VK_BLEND_OP_ADD,
                                                        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                                            VK_COLOR_COMPONENT_B_BIT |
                                                            VK_COLOR_COMPONENT_A_BIT};

}  // namespace

Result<Painter> Painter::create(const Device& device) {
  VORPIPE_VAR(bindings, Bindings::create(device, paint_bindings, 0));
  VORPIPE_VAR(pass, createRenderPass(device, target_formats));
  const std::array writes = {write_all, write_all};
  Result<Handle<VkPipeline>> pipeline =
      createTrianglePipeline(device, bindings.layout(), pass.get(),
                             {shaders::polygon_vert(), shaders::cell_frag(), vertices, attributes, writes});
  if (!pipeline) return tl::unexpected(std::move(pipeline).error());
  return Painter(std::move(bindings), std::move(pass), std::move(*pipeline));
}

Result<void> Painter::setPalette(const Device& device, const Palette& palette) {
  VORPIPE_TRY(palette_.reserve(device, sizeof(Palette), sizeof(Palette)));
  std::memcpy(palette_.data(), palette.data(), sizeof(Palette));
  bindings_.setTexels(device, BINDING_PALETTE, palette_.texels());
  return {};
}

template <class Draw>
void Painter::recordPass(const Device& device, VkCommandBuffer commands, const Target& target,
                         VkBuffer vertices, VkBuffer indices, const Draw& draw) const {
  const VolkDeviceTable& api = device.api();
  const VkRect2D area{{0, 0}, target.extent()};
  auto begin = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
  begin.renderPass = pass_.get();
  begin.framebuffer = target.framebuffer();
  begin.renderArea = area;
  api.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  const VkViewport viewport{
      0, 0, static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1};
  api.vkCmdSetViewport(commands, 0, 1, &viewport);
  api.vkCmdSetScissor(commands, 0, 1, &area);
  api.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
  const VkDescriptorSet set = bindings_.set();
  api.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, bindings_.layout(), 0, 1, &set, 0,
                              nullptr);
  const VkDeviceSize start = 0;
  api.vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &start);
  api.vkCmdBindIndexBuffer(commands, indices, 0, VK_INDEX_TYPE_UINT32);
  draw(api);
  api.vkCmdEndRenderPass(commands);
}

void Painter::record(const Device& device, VkCommandBuffer commands, const Target& target,
                     const Triangles& triangles) const {
  auto order = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  order.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  order.dstAccessMask =
      VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_INDEX_READ_BIT | VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT;
  device.api().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                    VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_VERTEX_INPUT_BIT,
                                    0, 1, &order, 0, nullptr, 0, nullptr);
  recordPass(device, commands, target, triangles.vertices, triangles.indices,
             [&](const VolkDeviceTable& api) {
               api.vkCmdDrawIndexedIndirect(commands, triangles.arguments, 0, 1, 0);
             });
}

Result<void> Painter::draw(Device& device, const Target& target, std::span<const DrawMark> corners,
                           std::span<const std::uint32_t> corner_of, std::uint64_t most) {
  assert(corners.size() <= most && corner_of.size() <= 3 * most);
  VORPIPE_TRY(corners_.reserve(device, corners.size_bytes(), most * sizeof(DrawMark)));
  VORPIPE_TRY(corner_of_.reserve(device, corner_of.size_bytes(), 3 * most * sizeof(corner_of[0])));
  std::memcpy(corners_.data(), corners.data(), corners.size_bytes());
  std::memcpy(corner_of_.data(), corner_of.data(), corner_of.size_bytes());
  const auto count = static_cast<std::uint32_t>(corner_of.size());
  return device.run([&](VkCommandBuffer commands) {
    recordPass(device, commands, target, corners_.get(), corner_of_.get(),
               [&](const VolkDeviceTable& api) { api.vkCmdDrawIndexed(commands, count, 1, 0, 0, 0); });
  });
}

}  // namespace vorpipe::vulkan
