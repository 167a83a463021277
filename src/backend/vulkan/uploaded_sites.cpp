#include "backend/vulkan/uploaded_sites.h"

#include <cassert>
#include <cstring>

#include "backend/site_texels.h"
#include "backend/vulkan/error.h"

namespace vorpipe::vulkan {

Result<void> UploadedSites::upload(const Device& device, Bindings& bindings, const SiteSet& sites,
                                   std::span<const std::uint8_t> palette_index, const BackendInfo& limits) {
  const std::size_t count = sites.size();
  const std::vector<std::uint32_t>& first = sites.grid.offsets;
  assert(count <= limits.max_sites && first.size() <= limits.max_bins + 1);
  VORPIPE_TRY(grid_.reserve(device, sizeof(SiteGridUniform), sizeof(SiteGridUniform)));
  VORPIPE_TRY(sites_.reserve(device, count * sizeof(SiteTexel), limits.max_sites * sizeof(SiteTexel)));
  VORPIPE_TRY(bins_.reserve(device, first.size() * sizeof(std::uint32_t),
                            (limits.max_bins + 1) * sizeof(std::uint32_t)));
  const SiteGridUniform block = siteGridUniform(sites);
  std::memcpy(grid_.data(), &block, sizeof(block));
  writeSiteTexels(sites, sites_.data());
  std::memcpy(bins_.data(), first.data(), first.size() * sizeof(std::uint32_t));
  bindings.setUniform(device, BINDING_GRID, grid_.get());
  bindings.setTexels(device, BINDING_SITES, sites_.texels());
  bindings.setTexels(device, BINDING_BINS, bins_.texels());
  weighted_ = !sites.weight.empty();
  if (weighted_) VORPIPE_TRY(uploadWeights(device, bindings, sites, limits));
  if (palette_index.empty()) return {};
  VORPIPE_TRY(marks_.reserve(device, count * sizeof(SiteMark), limits.max_sites * sizeof(SiteMark)));
  writeSiteMarks(sites, palette_index, marks_.data());
  bindings.setTexels(device, BINDING_MARKS, marks_.texels());
  return {};
}

Result<void> UploadedSites::uploadWeights(const Device& device, Bindings& bindings, const SiteSet& sites,
                                          const BackendInfo& limits) {
  const std::size_t bytes = heaviestBytes(sites);
  VORPIPE_TRY(
      weights_.reserve(device, sites.size() * sizeof(WeightTexel), limits.max_sites * sizeof(WeightTexel)));
  // Four to a texel, and no more than twice as many as bins.
  const std::size_t most_bytes = (limits.max_bins + 1) * 4 * sizeof(float);
  VORPIPE_TRY(heaviest_.reserve(device, bytes, most_bytes));
  writeWeightTexels(sites, weights_.data());
  writeHeaviest(sites, heaviest_.data());
  bindings.setTexels(device, BINDING_WEIGHTS, weights_.texels());
  bindings.setTexels(device, BINDING_HEAVIEST, heaviest_.texels());
  return {};
}

}  // namespace vorpipe::vulkan
