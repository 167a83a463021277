/// Pipelines that draw triangles with a vertex and a fragment shader.
#pragma once

#include <volk.h>

#include <span>

#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
#include "shaders.h"

namespace vorpipe::vulkan {

/// The parts in which these pipelines differ.
struct TriangleParts {
  shaders::Spirv vertex, fragment;
  VkVertexInputBindingDescription vertices;
  std::span<const VkVertexInputAttributeDescription> attributes;
  std::span<const VkPipelineColorBlendAttachmentState> writes;  ///< for each attachment of the pass
};

/// Both sides are drawn; viewport and scissor are set when it is used.
Result<Handle<VkPipeline>> createTrianglePipeline(const Device& device, VkPipelineLayout layout,
                                                  VkRenderPass pass, const TriangleParts& parts);

}  // namespace vorpipe::vulkan
