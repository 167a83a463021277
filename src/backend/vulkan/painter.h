/// Draws triangles onto a Target: those of the compute pipeline, or the caller's.
#pragma once

#include <volk.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/vulkan/bindings.h"
#include "backend/vulkan/buffer.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
#include "backend/vulkan/physical.h"
#include "backend/vulkan/target.h"

namespace vorpipe::vulkan {

/// What the compute pipeline made: vertices of vertex_bytes, indices as uint32, one
/// VkDrawIndexedIndirectCommand.
struct Triangles {
  VkBuffer vertices, indices, arguments;
};

class Painter {
 public:
  static Result<Painter> create(const Device& device);

  /// The device must not be drawing.
  Result<void> setPalette(const Device& device, const Palette& palette);
  /// Records a barrier after compute shaders, and the drawing over the picture.
  void record(const Device& device, VkCommandBuffer commands, const Target& target,
              const Triangles& triangles) const;
  /// Draws the caller's triangles over the picture; at most `most` corners and triangles.
  Result<void> draw(Device& device, const Target& target, std::span<const DrawMark> corners,
                    std::span<const std::uint32_t> corner_of, std::uint64_t most);

  [[nodiscard]] VkRenderPass pass() const { return pass_.get(); }

 private:
  template <class Draw>
  void recordPass(const Device& device, VkCommandBuffer commands, const Target& target, VkBuffer vertices,
                  VkBuffer indices, const Draw& draw) const;

  Painter(Bindings bindings, Handle<VkRenderPass> pass, Handle<VkPipeline> pipeline)
      : bindings_(std::move(bindings)), pass_(std::move(pass)), pipeline_(std::move(pipeline)) {}

  Bindings bindings_;
  Handle<VkRenderPass> pass_;
  Handle<VkPipeline> pipeline_;
  Buffer palette_{
      {"the palette", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload, VK_FORMAT_R8G8B8A8_UNORM}};
  Buffer corners_{{"corners of triangles", VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, Placement::upload}};
  Buffer corner_of_{{"triangles", VK_BUFFER_USAGE_INDEX_BUFFER_BIT, Placement::upload}};
};

}  // namespace vorpipe::vulkan
