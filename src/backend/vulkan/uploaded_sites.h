/// The sites of an upload on the device, their weights, and their grid.
#pragma once

#include <volk.h>

#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/vulkan/bindings.h"
#include "backend/vulkan/buffer.h"
#include "backend/vulkan/device.h"

namespace vorpipe::vulkan {

class UploadedSites {
 public:
  /// Replaces them and binds them; palette_index may be empty if nothing will be drawn. The set has at most
  /// max_sites sites and max_bins bins.
  Result<void> upload(const Device& device, Bindings& bindings, const SiteSet& sites,
                      std::span<const std::uint8_t> palette_index, const BackendInfo& limits);

  /// The texels of the bins.
  [[nodiscard]] VkBufferView bins() const { return bins_.texels(); }
  [[nodiscard]] bool weighted() const { return weighted_; }

 private:
  Result<void> uploadWeights(const Device& device, Bindings& bindings, const SiteSet& sites,
                             const BackendInfo& limits);

  bool weighted_ = false;
  Buffer grid_{{"the grid", VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, Placement::upload}};
  Buffer sites_{
      {"sites", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload, VK_FORMAT_R32G32B32A32_SFLOAT}};
  Buffer bins_{{"bins", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload, VK_FORMAT_R32_UINT}};
  Buffer weights_{
      {"weights", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload, VK_FORMAT_R32G32_SFLOAT}};
  Buffer heaviest_{{"weights of bins", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload,
                    VK_FORMAT_R32G32B32A32_SFLOAT}};
  Buffer marks_{
      {"marks of sites", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload, VK_FORMAT_R32G32_UINT}};
};

}  // namespace vorpipe::vulkan
