/// Converts polygons in device memory to a list of triangles there, for an indirect draw.
#pragma once

#include <volk.h>

#include <cstddef>

#include "backend/vulkan/bindings.h"
#include "backend/vulkan/buffer.h"
#include "backend/vulkan/compute_kernels.h"
#include "backend/vulkan/device.h"

namespace vorpipe::vulkan {

class TriangleList {
 public:
  static Result<TriangleList> create(const Device& device);

  /// Makes room for `polygons` polygons, each of at most `room` vertices and with memory for as many, which
  /// is EDGES_FAST or EDGES_MOST.
  Result<void> reserve(const Device& device, std::size_t polygons, std::size_t room);
  /// Makes what record() needs.
  Result<void> prepare(const Device& device, ComputeKernels& kernels);
  /// Records the computation of indices() and arguments() from the first `polygons` of counts(), in the order
  /// of the polygons. The caller has already synchronized the counts.
  void record(const Device& device, VkCommandBuffer commands, std::size_t polygons) const;

  /// How many triangles each polygon has, as uint32: the device writes it.
  [[nodiscard]] VkBuffer counts() const { return counts_.get(); }
  /// Vertices by index, as uint32; polygon p has the indices p * room and following.
  [[nodiscard]] VkBuffer indices() const { return indices_.get(); }
  /// A VkDrawIndexedIndirectCommand.
  [[nodiscard]] VkBuffer arguments() const { return sums_.get(); }

 private:
  explicit TriangleList(Bindings bindings) : bindings_(std::move(bindings)) {}

  Bindings bindings_;
  Buffer counts_{{"counts", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::device}};
  Buffer sums_{
      {"sums", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, Placement::device}};
  Buffer indices_{
      {"indices", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT, Placement::device}};
  std::size_t room_ = 0;
  VkPipeline sum_ = VK_NULL_HANDLE, scan_ = VK_NULL_HANDLE, list_ = VK_NULL_HANDLE;  ///< of ComputeKernels
};

}  // namespace vorpipe::vulkan
