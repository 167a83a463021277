/// The graphics pipelines: shaders and fixed state, each created on first use.
#pragma once

#include <volk.h>

#include <array>
#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"

namespace vorpipe::vulkan {

/// What a pipeline takes for each point, and from which vertex buffers.
enum class Entries : std::uint8_t {
  lists,  ///< an entry of a batch from buffer 0 and its mark from buffer 1, both as they lie in memory
  sites,  ///< the index of a site of the upload from buffer 0
  weighted_sites,  ///< the same, of sites with weights
};

inline constexpr std::size_t entry_kinds = 3;

class Pipelines {
 public:
  static Result<Pipelines> create(const Device& device);

  /// Clips and draws, within targetPass().
  Result<VkPipeline> draw(const Device& device, VkPipelineLayout layout, Entries entries, Capacity capacity);
  /// Clips and writes neighbors, within emptyPass(). It reads one mark, whose contents do not matter, and
  /// lists are clipped with the capacity EDGES_MOST.
  Result<VkPipeline> edges(const Device& device, VkPipelineLayout layout, Entries entries, Capacity capacity);

  [[nodiscard]] VkRenderPass targetPass() const { return target_pass_.get(); }
  [[nodiscard]] VkRenderPass emptyPass() const { return empty_pass_.get(); }

 private:
  struct Stages;

  Pipelines() = default;
  Result<VkPipeline> made(const Device& device, VkPipelineLayout layout, const Stages& stages,
                          Handle<VkPipeline>& pipeline) const;
  Result<Handle<VkPipeline>> build(const Device& device, VkPipelineLayout layout, const Stages& stages) const;

  Handle<VkRenderPass> target_pass_;  ///< of Target
  Handle<VkRenderPass> empty_pass_;   ///< without an attachment
  Handle<VkPipelineCache> cache_;
  std::array<Handle<VkPipeline>, 2 * entry_kinds> draw_, edges_;  ///< by Entries, then by Capacity
};

}  // namespace vorpipe::vulkan
