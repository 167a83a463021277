/// Compute shaders, each created on first use, and how they are run.
#pragma once

#include <volk.h>

#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "backend/vulkan/bindings.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
#include "shaders.h"

namespace vorpipe::vulkan {

/// The push constants of slice.glsl: which part of the work a dispatch takes on.
struct Slice {
  std::uint32_t first, count;
};

/// Groups that one dimension of a dispatch holds on any device.
inline constexpr std::size_t most_groups = 65535;

class ComputeKernels {
 public:
  using Code = shaders::Spirv;

  static Result<ComputeKernels> create(const Device& device);

  /// Returns the pipeline of a module of shaders.h, only for layouts like this one. flag is the value of the
  /// module's specialization constant 0, if it has one.
  Result<VkPipeline> kernel(const Device& device, VkPipelineLayout layout, Code code, bool flag = false);

 private:
  ComputeKernels() = default;

  Handle<VkPipelineCache> cache_;
  std::map<std::pair<std::string_view, bool>, Handle<VkPipeline>> made_;  ///< by name and flag
};

/// Records one invocation of a kernel for each of `invocations`, which fit into one dimension.
void dispatch(const Device& device, VkCommandBuffer commands, VkPipeline kernel, const Bindings& bindings,
              const Slice& slice, std::size_t invocations);

/// Location of the number of groups of a dispatch.
struct DispatchArguments {
  VkBuffer buffer;
  VkDeviceSize offset;
};

/// Records as many groups of a kernel as the device reads there.
void dispatchIndirect(const Device& device, VkCommandBuffer commands, VkPipeline kernel,
                      const Bindings& bindings, const Slice& slice, const DispatchArguments& arguments);

/// Records that the first `bytes` of a buffer are zeroed before later shaders write there. The buffer must
/// allow transfers.
void clearBefore(const Device& device, VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize bytes);

/// Records a barrier: later shaders see what shaders have written so far.
void orderShaders(const Device& device, VkCommandBuffer commands);

}  // namespace vorpipe::vulkan
