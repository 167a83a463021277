/// The graphics pipelines: shaders and fixed state, each made when it is first asked for.
#pragma once

#include <volk.h>

#include <array>
#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"

namespace vorpipe::vulkan {

/// The vertex buffers: the entries of a batch and their marks, both as they lie in memory.
inline constexpr std::uint32_t vertices_entries = 0;
inline constexpr std::uint32_t vertices_marks = 1;

class Pipelines {
 public:
  static Result<Pipelines> create(const Device& device);

  /// Clips and draws, within targetPass().
  Result<VkPipeline> draw(const Device& device, VkPipelineLayout layout, Room room);
  /// Clips and writes edges down, within emptyPass(); it reads one mark, whatever it holds.
  Result<VkPipeline> edges(const Device& device, VkPipelineLayout layout);

  [[nodiscard]] VkRenderPass targetPass() const { return target_pass_.get(); }
  [[nodiscard]] VkRenderPass emptyPass() const { return empty_pass_.get(); }

 private:
  struct Stages;

  Pipelines() = default;
  Result<Handle<VkPipeline>> build(const Device& device, VkPipelineLayout layout, const Stages& stages) const;

  Handle<VkRenderPass> target_pass_;  ///< of Target
  Handle<VkRenderPass> empty_pass_;   ///< without an attachment
  Handle<VkPipelineCache> cache_;
  std::array<Handle<VkPipeline>, 2> draw_;  ///< by Room
  Handle<VkPipeline> edges_;
};

}  // namespace vorpipe::vulkan
