/// The Vulkan devices of this machine, and which of them to take.
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

/// Of a vertex as polygons.comp writes it: position, id, palette_index.
inline constexpr std::size_t vertex_bytes = 4 * sizeof(std::uint32_t);

/// A device before it is opened. `info` says whether it can be used and why not.
struct Physical {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceInfo info;
  Capabilities capabilities;  ///< masked
  std::uint32_t queue_family = 0;
  bool portability_subset = false;
  bool swapchain = false;  ///< has VK_KHR_swapchain
  Waiting waiting{};       ///< told when a pipeline takes seconds; BackendOptions::waiting
};

/// How many things of `bytes` a device has room for: one allocation holds all of them, and half of its memory
/// holds them with all that comes along, `bytes_in_all` for each. The rest is for pictures and answers.
std::uint64_t mostOf(const Capabilities& capabilities, std::uint64_t bytes, std::uint64_t bytes_in_all);

/// The largest side of a picture whose planes, with four bytes to a pixel, are an allocation each.
std::uint64_t largestView(const Capabilities& capabilities);

/// What a device is to run; the backends "vulkan-geometry" and "vulkan-compute".
enum class Pipeline : std::uint8_t { geometry, compute };

/// The name of its backend.
std::string_view nameOf(Pipeline pipeline);

/// The devices in the order of vkEnumeratePhysicalDevices, as they would be for a pipeline and with mask.
/// Errors: none at all (device), an unknown name in the mask (input).
Result<std::vector<Physical>> enumerate(const Instance& instance, const Mask& mask,
                                        Pipeline pipeline = Pipeline::geometry);

/// The device that wanted names, by index or by a part of its name in any case; if empty, the best
/// usable one. Error (device): there is none; the message lists what there is.
Result<Physical> choose(std::span<const Physical> devices, std::string_view wanted);

}  // namespace vorpipe::vulkan
