#include "backend/vulkan/pipelines.h"

#include <cassert>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "backend/vulkan/device.h"
#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "backend/vulkan/target.h"
#include "base/try.h"
#include "shaders.h"

namespace vorpipe::vulkan {

using Code = shaders::Spirv;

/// The parts in which pipelines differ.
struct Pipelines::Stages {
  Code vertex, geometry;
  std::optional<Code> fragment;  ///< none: nothing is rasterized
  VkRenderPass pass;
  std::uint32_t attachments;
  Entries entries;
  std::uint32_t mark_stride;  ///< 0: every entry gets the first mark
};

namespace {

using Entry = CellBatch<float>::Entry;
static_assert(offsetof(Entry, count) == offsetof(Entry, first) + 4);
static_assert(offsetof(Entry, south) == offsetof(Entry, west) + 4);
static_assert(offsetof(Entry, east) == offsetof(Entry, west) + 8);
static_assert(offsetof(Entry, north) == offsetof(Entry, west) + 12);
static_assert(offsetof(Entry, origin_offset) == offsetof(Entry, reach) + 4);
static_assert(offsetof(DrawMark, y) == offsetof(DrawMark, x) + 4);
static_assert(offsetof(DrawMark, palette_index) == offsetof(DrawMark, id) + 4);

// The inputs of cell.vert, by location.
constexpr std::array<VkVertexInputAttributeDescription, 5> list_inputs = {{
    {0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Entry, west)},
    {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(Entry, reach)},
    {2, 0, VK_FORMAT_R32G32_UINT, offsetof(Entry, first)},
    {3, 1, VK_FORMAT_R32G32_SFLOAT, offsetof(DrawMark, x)},
    {4, 1, VK_FORMAT_R32G32_UINT, offsetof(DrawMark, id)},
}};

// The input of site.vert.
constexpr std::array<VkVertexInputAttributeDescription, 1> site_inputs = {{{0, 0, VK_FORMAT_R32_UINT, 0}}};

std::size_t indexOf(Entries entries, Capacity capacity) {
  return 2 * static_cast<std::size_t>(entries) + (capacity == Capacity::small ? 0U : 1U);
}

Code vertexCode(Entries entries) {
  return entries == Entries::lists ? shaders::cell_vert() : shaders::site_vert();
}

Result<Handle<VkRenderPass>> createEmptyPass(const Device& device) {
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  auto info = structure<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  return create(device.handle(), device.api().vkCreateRenderPass, device.api().vkDestroyRenderPass, info,
                "vkCreateRenderPass");
}

// The state that is the same in every pipeline, next to the structure that points at it.
struct FixedState {
  std::array<VkVertexInputBindingDescription, 2> vertices;
  VkPipelineVertexInputStateCreateInfo input = structure<VkPipelineVertexInputStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  VkPipelineInputAssemblyStateCreateInfo assembly = structure<VkPipelineInputAssemblyStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  VkPipelineViewportStateCreateInfo viewport =
      structure<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  VkPipelineRasterizationStateCreateInfo raster = structure<VkPipelineRasterizationStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  VkPipelineMultisampleStateCreateInfo samples = structure<VkPipelineMultisampleStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  std::array<VkPipelineColorBlendAttachmentState, 2> writes{};
  VkPipelineColorBlendStateCreateInfo blend = structure<VkPipelineColorBlendStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  std::array<VkDynamicState, 2> dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic =
      structure<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);

  FixedState(Entries entries, std::uint32_t mark_stride, bool rasterized, std::uint32_t attachments)
      : vertices{{{0, sizeof(Entry), VK_VERTEX_INPUT_RATE_VERTEX},
                  {1, mark_stride, VK_VERTEX_INPUT_RATE_VERTEX}}} {
    const bool sites = entries != Entries::lists;
    if (sites) vertices[0].stride = sizeof(std::uint32_t);
    input.vertexBindingDescriptionCount = sites ? 1 : 2;
    input.pVertexBindingDescriptions = vertices.data();
    input.vertexAttributeDescriptionCount =
        static_cast<std::uint32_t>(sites ? site_inputs.size() : list_inputs.size());
    input.pVertexAttributeDescriptions = sites ? site_inputs.data() : list_inputs.data();
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    raster.rasterizerDiscardEnable = rasterized ? VK_FALSE : VK_TRUE;
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.lineWidth = 1.0F;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    for (VkPipelineColorBlendAttachmentState& write : writes) {
      write.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                             VK_COLOR_COMPONENT_A_BIT;
    }
    blend.attachmentCount = attachments;
    blend.pAttachments = writes.data();
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();
  }
  FixedState(const FixedState&) = delete;
  FixedState& operator=(const FixedState&) = delete;
};

}  // namespace

Result<Pipelines> Pipelines::create(const Device& device) {
  Pipelines pipelines;
  VORPIPE_VAR(target_pass, createRenderPass(device, target_formats));
  pipelines.target_pass_ = std::move(target_pass);
  VORPIPE_VAR(empty_pass, createEmptyPass(device));
  pipelines.empty_pass_ = std::move(empty_pass);
  const auto info = structure<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
  VORPIPE_VAR(cache, vulkan::create(device.handle(), device.api().vkCreatePipelineCache,
                                    device.api().vkDestroyPipelineCache, info, "vkCreatePipelineCache"));
  pipelines.cache_ = std::move(cache);
  return pipelines;
}

Result<VkPipeline> Pipelines::made(const Device& device, VkPipelineLayout layout, const Stages& stages,
                                   Handle<VkPipeline>& pipeline) const {
  if (!pipeline) {
    VORPIPE_VAR(built, build(device, layout, stages));
    pipeline = std::move(built);
  }
  return pipeline.get();
}

Result<VkPipeline> Pipelines::draw(const Device& device, VkPipelineLayout layout, Entries entries,
                                   Capacity capacity) {
  const bool small = capacity == Capacity::small;
  Code geometry = small ? shaders::cell_list_fast() : shaders::cell_list_roomy();
  if (entries == Entries::sites) geometry = small ? shaders::cell_grid_fast() : shaders::cell_grid_roomy();
  assert(entries != Entries::weighted_sites);
  return made(
      device, layout,
      {vertexCode(entries), geometry, shaders::cell_frag(), targetPass(), 2, entries, sizeof(DrawMark)},
      draw_[indexOf(entries, capacity)]);
}

Result<VkPipeline> Pipelines::edges(const Device& device, VkPipelineLayout layout, Entries entries,
                                    Capacity capacity) {
  const bool small = capacity == Capacity::small;
  Code geometry = shaders::edges_list_roomy();
  if (entries == Entries::sites) geometry = small ? shaders::edges_grid_fast() : shaders::edges_grid_roomy();
  if (entries == Entries::weighted_sites) {
    geometry = small ? shaders::edges_grid_fast_weighted() : shaders::edges_grid_roomy_weighted();
  }
  return made(device, layout, {vertexCode(entries), geometry, {}, emptyPass(), 0, entries, 0},
              edges_[indexOf(entries, capacity)]);
}

Result<Handle<VkPipeline>> Pipelines::build(const Device& device, VkPipelineLayout layout,
                                            const Stages& stages) const {
  const bool rasterized = stages.fragment.has_value();
  std::vector<Handle<VkShaderModule>> modules;
  std::vector<VkPipelineShaderStageCreateInfo> stage_infos;
  for (const auto& [code, stage] : {std::pair(std::optional(stages.vertex), VK_SHADER_STAGE_VERTEX_BIT),
                                    std::pair(std::optional(stages.geometry), VK_SHADER_STAGE_GEOMETRY_BIT),
                                    std::pair(stages.fragment, VK_SHADER_STAGE_FRAGMENT_BIT)}) {
    if (!code) continue;
    VORPIPE_VAR(module, shaderModule(device, *code));
    auto stage_info =
        structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    stage_info.stage = stage;
    stage_info.module = module.get();
    stage_info.pName = "main";
    stage_infos.push_back(stage_info);
    modules.push_back(std::move(module));
  }
  const FixedState fixed(stages.entries, stages.mark_stride, rasterized, stages.attachments);
  auto info = structure<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  info.stageCount = static_cast<std::uint32_t>(stage_infos.size());
  info.pStages = stage_infos.data();
  info.pVertexInputState = &fixed.input;
  info.pInputAssemblyState = &fixed.assembly;
  info.pViewportState = rasterized ? &fixed.viewport : nullptr;
  info.pRasterizationState = &fixed.raster;
  info.pMultisampleState = rasterized ? &fixed.samples : nullptr;
  info.pColorBlendState = rasterized ? &fixed.blend : nullptr;
  info.pDynamicState = rasterized ? &fixed.dynamic : nullptr;
  info.layout = layout;
  info.renderPass = stages.pass;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult made = device.pipelines().time(stages.geometry.name, [&] {
    return device.api().vkCreateGraphicsPipelines(device.handle(), cache_.get(), 1, &info, nullptr,
                                                  &pipeline);
  });
  VORPIPE_TRY(check(made, "vkCreateGraphicsPipelines"));
  return Handle<VkPipeline>(device.handle(), pipeline, device.api().vkDestroyPipeline);
}

}  // namespace vorpipe::vulkan
