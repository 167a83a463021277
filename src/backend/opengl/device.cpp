#include "backend/opengl/device.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>

#include "backend/opengl/gl.h"
#include "base/words.h"
#include "layout.glsl"

namespace vorpipe::opengl {
namespace {

// Components that one vertex of a strip writes: position, mark, status.
constexpr std::uint64_t components_per_vertex = 8;
constexpr std::uint64_t palette_size = std::tuple_size_v<Palette>;

std::string text(GLenum name) {
  const auto* value = reinterpret_cast<const char*>(glGetString(name));
  return value == nullptr ? "" : value;
}

// OpenGL does not report the kind of a device; its makers' names do, where it matters for the choice.
std::string typeOf(std::string_view renderer, std::string_view vendor) {
  struct Known {
    std::string_view part, type;
  };
  constexpr std::array<Known, 9> known = {{{"llvmpipe", "cpu"},
                                           {"softpipe", "cpu"},
                                           {"swrast", "cpu"},
                                           {"software", "cpu"},
                                           {"virgl", "virtual"},
                                           {"svga3d", "virtual"},
                                           {"nvidia", "discrete"},
                                           {"intel(r) arc", "discrete"},
                                           {"intel", "integrated"}}};
  const auto words = lowerCase(renderer) + " " + lowerCase(vendor);
  const auto* const it =
      std::ranges::find_if(known, [&](const Known& k) { return words.find(k.part) != std::string::npos; });
  return std::string(it == known.end() ? "other" : it->type);
}

std::uint64_t limit(GLenum name) { return static_cast<std::uint64_t>(std::max(integer(name), 0)); }

Capabilities capabilitiesOfCurrent() {
  std::array<GLint, 2> viewport{};
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  Capabilities c;
  c.geometry_shader = true;
  c.shader_float64 = true;
  c.max_texel_buffer_elements = limit(GL_MAX_TEXTURE_BUFFER_SIZE);
  c.max_geometry_output_vertices = limit(GL_MAX_GEOMETRY_OUTPUT_VERTICES);
  c.max_geometry_total_output_components = limit(GL_MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS);
  c.max_image_dimension_2d = limit(GL_MAX_RENDERBUFFER_SIZE);
  c.max_framebuffer_width = static_cast<std::uint64_t>(std::max(viewport[0], 0));
  c.max_framebuffer_height = static_cast<std::uint64_t>(std::max(viewport[1], 0));
  c.sub_pixel_precision_bits = limit(GL_SUBPIXEL_BITS);
  return c;
}

// Why the backend cannot use a device of these capabilities; empty if it can.
std::string shortcoming(const Capabilities& c) {
  const auto edges = std::uint64_t{EDGES_MOST};
  const auto too_small = [](std::string_view name, std::uint64_t has, std::uint64_t needs) {
    return fmt::format("{} is {}, and {} is needed; use another backend", name, has, needs);
  };
  if (!c.geometry_shader) return "it has no geometryShader, which cells are drawn by; use another backend";
  if (c.max_geometry_output_vertices < edges) {
    return too_small("maxGeometryOutputVertices", c.max_geometry_output_vertices, edges);
  }
  if (c.max_geometry_total_output_components < edges * components_per_vertex) {
    return too_small("maxGeometryTotalOutputComponents", c.max_geometry_total_output_components,
                     edges * components_per_vertex);
  }
  if (c.max_texel_buffer_elements < palette_size) {
    return too_small("maxTexelBufferElements", c.max_texel_buffer_elements, palette_size);
  }
  if (c.sub_pixel_precision_bits < least_subpixel_bits) {
    return too_small("subPixelPrecisionBits", c.sub_pixel_precision_bits, least_subpixel_bits);
  }
  return {};
}

Device unusable(const Error& why) {
  Device device;
  device.info.backend = "opengl";
  device.info.name = "none";
  device.info.type = "other";
  device.info.reason = why.message;
  return device;
}

Device describe(Result<Context> context, const Mask& mask) {
  if (!context) return unusable(context.error());
  const auto scope = context->enter();
  if (!scope) return unusable(scope.error());
  Device device;
  device.info.backend = "opengl";
  device.info.name = text(GL_RENDERER);
  device.info.driver = fmt::format("{}, OpenGL {}", text(GL_VENDOR), text(GL_VERSION));
  device.info.type = typeOf(device.info.name, text(GL_VENDOR));
  device.capabilities = capabilitiesOfCurrent();
  const auto masked = applyMask(device.capabilities, mask);
  device.info.features = listFeatures(device.capabilities);
  device.info.limits = listLimits(device.capabilities);
  device.info.reason = masked ? shortcoming(device.capabilities) : masked.error().message;
  device.info.usable = device.info.reason.empty();
  device.context = std::move(*context);
  return device;
}

// Smaller is better.
int rank(const DeviceInfo& info) {
  constexpr std::array<std::string_view, 5> order = {"discrete", "integrated", "other", "virtual", "cpu"};
  return static_cast<int>(std::ranges::find(order, info.type) - order.begin());
}

tl::unexpected<Error> cannotUse(const Device& device, std::size_t index) {
  if (!device.context) return tl::unexpected(Error{ErrorCode::device, device.info.reason});
  return tl::unexpected(Error{ErrorCode::device, fmt::format("opengl: device {} ({}) cannot be used: {}",
                                                             index, device.info.name, device.info.reason)});
}

// The best of the devices with that index or part of their name, usable ones first; the list's end if none
// is.
std::size_t bestOf(const std::vector<Device>& devices, std::string_view wanted) {
  std::size_t best = devices.size();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (!isIndexOrPartOf(wanted, i, devices[i].info.name)) continue;
    const auto key = [&](std::size_t k) { return std::pair(!devices[k].info.usable, rank(devices[k].info)); };
    if (best == devices.size() || key(i) < key(best)) best = i;
  }
  return best;
}

}  // namespace

std::vector<Device> findDevices(const Mask& mask, Drivers drivers) {
  auto contexts = openContexts(drivers);
  std::vector<Device> devices;
  if (!contexts) {
    devices.push_back(unusable(contexts.error()));
    return devices;
  }
  for (auto& context : *contexts) devices.push_back(describe(std::move(context), mask));
  return devices;
}

Result<Device> chooseDevice(std::vector<Device> devices, std::string_view wanted) {
  const std::size_t index = bestOf(devices, wanted);
  if (index >= devices.size()) {
    return tl::unexpected(
        Error{ErrorCode::device, fmt::format("opengl: there is no device '{}' among the {} here; list "
                                             "them with 'vorpipe devices'",
                                             wanted, devices.size())});
  }
  if (!devices[index].info.usable) return cannotUse(devices[index], index);
  return std::move(devices[index]);
}

BackendInfo backendInfo(const Device& device) {
  // Core draws larger pictures in parts of this size.
  constexpr std::uint64_t largest_view = 4096;
  // The most that an upload and a batch may hold if the device sets no lower limit: 256 MiB of sites or
  // lines, 192 MiB of entries and marks.
  constexpr std::uint64_t most_texels = std::uint64_t{1} << 24;
  constexpr std::uint32_t most_entries = std::uint32_t{1} << 22;
  const Capabilities& c = device.capabilities;
  BackendInfo info;
  info.device = device.info;
  info.max_view = static_cast<int>(
      std::min({largest_view, c.max_image_dimension_2d, c.max_framebuffer_width, c.max_framebuffer_height}));
  info.max_sites = std::min(c.max_texel_buffer_elements, most_texels);
  info.max_bins = info.max_sites - 1;
  info.max_lines = info.max_sites;
  info.max_entries = most_entries;
  info.most_edges = EDGES_MOST;
  info.subpixel_bits = static_cast<int>(c.sub_pixel_precision_bits);
  return info;
}

}  // namespace vorpipe::opengl
