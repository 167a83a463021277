/// The capabilities of a device that vorpipe uses, under Vulkan's names for every API.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// Filled from a device, then lowered by a Mask before anything is decided or created. A limit
/// that an API does not have keeps its zero and is not listed.
struct Capabilities {
  bool geometry_shader = false;
  bool vertex_pipeline_stores_and_atomics = false;
  bool shader_float64 = false;
  bool unrolled_shaders = false;  ///< is faster with shaders whose loops the build has unrolled
  std::uint64_t max_texel_buffer_elements = 0;
  std::uint64_t max_storage_buffer_range = 0;
  std::uint64_t max_geometry_output_vertices = 0;
  std::uint64_t max_geometry_total_output_components = 0;
  std::uint64_t max_image_dimension_2d = 0;
  std::uint64_t max_framebuffer_width = 0;
  std::uint64_t max_framebuffer_height = 0;
  std::uint64_t sub_pixel_precision_bits = 0;
  std::uint64_t max_memory_allocation_size = 0;
  std::uint64_t heap_budget = 0;  ///< of the largest heap of the device's own memory
};

struct NamedFeature {
  std::string_view name;
  bool Capabilities::*member;
};

struct NamedLimit {
  std::string_view name;
  std::uint64_t Capabilities::*member;
};

inline constexpr std::array<NamedFeature, 4> known_features = {{
    {"geometryShader", &Capabilities::geometry_shader},
    {"vertexPipelineStoresAndAtomics", &Capabilities::vertex_pipeline_stores_and_atomics},
    {"shaderFloat64", &Capabilities::shader_float64},
    {"unrolledShaders", &Capabilities::unrolled_shaders},
}};

inline constexpr std::array<NamedLimit, 10> known_limits = {{
    {"maxTexelBufferElements", &Capabilities::max_texel_buffer_elements},
    {"maxStorageBufferRange", &Capabilities::max_storage_buffer_range},
    {"maxGeometryOutputVertices", &Capabilities::max_geometry_output_vertices},
    {"maxGeometryTotalOutputComponents", &Capabilities::max_geometry_total_output_components},
    {"maxImageDimension2D", &Capabilities::max_image_dimension_2d},
    {"maxFramebufferWidth", &Capabilities::max_framebuffer_width},
    {"maxFramebufferHeight", &Capabilities::max_framebuffer_height},
    {"subPixelPrecisionBits", &Capabilities::sub_pixel_precision_bits},
    {"maxMemoryAllocationSize", &Capabilities::max_memory_allocation_size},
    {"heapBudget", &Capabilities::heap_budget},
}};

/// Vulkan and OpenGL guarantee this many bits for a vertex's position inside a pixel.
inline constexpr std::uint64_t least_subpixel_bits = 4;

/// Disables the features and lowers the limits that mask names; a limit above the device's own has no effect.
/// Error (input): an unknown name; the message lists the known ones.
Result<void> applyMask(Capabilities& capabilities, const Mask& mask);

/// The features by name, as DeviceInfo lists them.
std::vector<std::pair<std::string, bool>> listFeatures(const Capabilities& capabilities);

/// The limits by name, as DeviceInfo lists them; those that are zero are left out.
std::vector<std::pair<std::string, std::uint64_t>> listLimits(const Capabilities& capabilities);

}  // namespace vorpipe
