/// The Vulkan devices of this machine, and the choice of one.
#pragma once

#include <volk.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "backend/capabilities.h"
#include "backend/vulkan/instance.h"
#include "vorpipe.h"

namespace vorpipe::vulkan {

/// Size of a vertex as polygons.comp writes it: position, id, palette_index.
inline constexpr std::size_t vertex_bytes = 4 * sizeof(std::uint32_t);

/// A device before it is opened. `info` says whether it can be used and why not.
struct Physical {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceInfo info;
  Capabilities capabilities;  ///< masked
  std::uint32_t queue_family = 0;
  bool portability_subset = false;
  bool swapchain = false;  ///< has VK_KHR_swapchain
  Waiting waiting{};       ///< called when a pipeline takes seconds; BackendOptions::waiting
};

/// Returns how many items of `bytes` a device has room for. One allocation holds all of them, and half of its
/// memory holds them with their associated data, `bytes_in_all` for each. The rest is for pictures and
/// answers.
std::uint64_t mostOf(const Capabilities& capabilities, std::uint64_t bytes, std::uint64_t bytes_in_all);

/// Returns the largest side of a picture if each plane, with four bytes per pixel, is one allocation.
std::uint64_t largestView(const Capabilities& capabilities);

/// The pipeline that a device runs; the backends "vulkan-geometry" and "vulkan-compute".
enum class Pipeline : std::uint8_t { geometry, compute };

/// Returns the name of the pipeline's backend.
std::string_view nameOf(Pipeline pipeline);

/// Returns the devices in the order of vkEnumeratePhysicalDevices, as they would be for a pipeline and with
/// mask. Errors: no device at all (device), an unknown name in the mask (input).
Result<std::vector<Physical>> enumerate(const Instance& instance, const Mask& mask,
                                        Pipeline pipeline = Pipeline::geometry);

/// Returns the device that `wanted` names, by index or by a part of its name in any case; if empty, the best
/// usable one. Error (device): no such device; the message lists the existing ones.
Result<Physical> choose(std::span<const Physical> devices, std::string_view wanted);

}  // namespace vorpipe::vulkan
