/// The sites of an upload, sorted into the bins of their grid by the device.
///
/// The host's own grid (Grid::offsets) is not read, and sites may come in any order: a counting sort finds
/// the bin of each in float, within SiteGridUniform::slack. Inside a bin they are ordered by index in the
/// set. That order requires a second sort of each bin: the counting sort leaves sites in the order in which
/// invocations arrive. A site's rank is its index in the result. All buffers that the search reads lie in the
/// device's own memory.
#pragma once

#include <volk.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/vulkan/bindings.h"
#include "backend/vulkan/buffer.h"
#include "backend/vulkan/compute_kernels.h"
#include "backend/vulkan/device.h"

namespace vorpipe::vulkan {

class SortedSites {
 public:
  static Result<SortedSites> create(const Device& device);

  /// Replaces the sites and binds them to the set of a search whose kernels map ranks to sites;
  /// palette_index may be empty if nothing will be drawn. The set has at most max_sites sites and max_bins
  /// bins.
  Result<void> upload(Device& device, Bindings& search, const SiteSet& sites,
                      std::span<const std::uint8_t> palette_index, const BackendInfo& limits);

  /// Where each bin begins, then the number of sites, as uint32: one more than there are bins.
  [[nodiscard]] VkBuffer starts() const { return starts_.get(); }
  /// By rank, the index of the site in the set, as uint32.
  [[nodiscard]] VkBuffer siteOfRank() const { return site_of_rank_.get(); }
  /// By index in the set, the rank of the site, as uint32.
  [[nodiscard]] VkBuffer rankOfSite() const { return rank_of_site_.get(); }

 private:
  struct Sizes {
    std::size_t sites, bins;
  };
  struct Steps {
    VkPipeline count, sum, scan, start, scatter, order, merge, gather;
  };
  /// A descriptor set for each group of steps that use the same buffers. Sorting inside bins has two: from
  /// one list into the other, and back.
  struct Sets {
    Bindings counting, scanning, ordering, reordering;
  };

  SortedSites(Sets sets, ComputeKernels kernels);

  Result<void> reserve(const Device& device, const Sizes& sizes, const BackendInfo& limits);
  void send(const SiteSet& sites);
  void bind(const Device& device, const Sizes& sizes);
  Result<Steps> steps(const Device& device);
  void record(const Device& device, VkCommandBuffer commands, const Steps& steps, const Sizes& sizes) const;
  void recordMerges(const Device& device, VkCommandBuffer commands, const Steps& steps,
                    std::size_t sites) const;

  Sets sets_;
  ComputeKernels kernels_;
  Buffer grid_{{"the grid", VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, Placement::upload}};
  Buffer sites_{
      {"sites", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload, VK_FORMAT_R32G32B32A32_SFLOAT}};
  Buffer marks_{
      {"marks of sites", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload, VK_FORMAT_R32G32_UINT}};
  Buffer counts_{{"counts of sites", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                  Placement::device}};
  Buffer sums_{{"sums", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::device}};
  Buffer merges_{{"merges", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                  Placement::upload}};
  Buffer spare_{{"sites in the making", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::device}};
  Buffer bin_of_site_, starts_, site_of_rank_, rank_of_site_, sorted_;
};

}  // namespace vorpipe::vulkan
