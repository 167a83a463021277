#include "backend/vulkan/physical.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "backend/cell_answers.h"
#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"
#include "base/words.h"
#include "layout.glsl"

namespace vorpipe::vulkan {
namespace {

// Of cell.geom, which has the most components: a position, a mark and a status.
constexpr std::uint64_t components_per_vertex = 8;

// Of a picture: colors, ids, and one of them on its way to the host.
constexpr std::uint64_t pixel_bytes = 4;
constexpr std::uint64_t planes = 3;

// For what every run needs, whatever its size.
constexpr std::uint64_t least_memory = std::uint64_t{1} << 16;

std::string_view typeName(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

int preference(std::string_view type) {
  constexpr std::string_view order[] = {"discrete", "integrated", "virtual", "cpu", "other"};
  return static_cast<int>(std::ranges::find(order, type) - std::begin(order));
}

Result<std::vector<VkExtensionProperties>> extensionsOf(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  VORPIPE_TRY(check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
                    "vkEnumerateDeviceExtensionProperties"));
  std::vector<VkExtensionProperties> extensions(count);
  VORPIPE_TRY(check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()),
                    "vkEnumerateDeviceExtensionProperties"));
  return extensions;
}

bool contains(std::span<const VkExtensionProperties> extensions, const char* name) {
  return std::ranges::any_of(extensions, [&](const VkExtensionProperties& extension) {
    return std::strcmp(extension.extensionName, name) == 0;
  });
}

// A device that has graphics has a family that has both.
std::optional<std::uint32_t> graphicsFamily(VkPhysicalDevice device) {
  constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  for (std::uint32_t family = 0; family < count; family++) {
    if ((families[family].queueFlags & wanted) == wanted) return family;
  }
  return std::nullopt;
}

Capabilities capabilitiesOf(VkPhysicalDevice device, const VkPhysicalDeviceLimits& limits) {
  VkPhysicalDeviceFeatures features{};
  vkGetPhysicalDeviceFeatures(device, &features);
  Capabilities capabilities;
  capabilities.geometry_shader = features.geometryShader == VK_TRUE;
  capabilities.vertex_pipeline_stores_and_atomics = features.vertexPipelineStoresAndAtomics == VK_TRUE;
  capabilities.shader_float64 = features.shaderFloat64 == VK_TRUE;
  capabilities.max_texel_buffer_elements = limits.maxTexelBufferElements;
  capabilities.max_storage_buffer_range = limits.maxStorageBufferRange;
  capabilities.max_geometry_output_vertices = limits.maxGeometryOutputVertices;
  capabilities.max_geometry_total_output_components = limits.maxGeometryTotalOutputComponents;
  capabilities.max_image_dimension_2d = limits.maxImageDimension2D;
  capabilities.max_framebuffer_width = limits.maxFramebufferWidth;
  capabilities.max_framebuffer_height = limits.maxFramebufferHeight;
  capabilities.sub_pixel_precision_bits = limits.subPixelPrecisionBits;
  return capabilities;
}

// Queries the size limit of one allocation, and the free part of the largest heap of the device's own memory.
// That is what the driver reports or, if it cannot, the whole heap. The device must support Vulkan 1.1.
void askForMemory(VkPhysicalDevice device, bool has_budget, Capabilities& capabilities) {
  auto maintenance = structure<VkPhysicalDeviceMaintenance3Properties>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES);
  auto properties = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  properties.pNext = &maintenance;
  vkGetPhysicalDeviceProperties2(device, &properties);
  capabilities.max_memory_allocation_size = maintenance.maxMemoryAllocationSize;
  auto budget = structure<VkPhysicalDeviceMemoryBudgetPropertiesEXT>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT);
  auto memory =
      structure<VkPhysicalDeviceMemoryProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2);
  if (has_budget) memory.pNext = &budget;
  vkGetPhysicalDeviceMemoryProperties2(device, &memory);
  const VkPhysicalDeviceMemoryProperties& all = memory.memoryProperties;
  for (std::uint32_t heap = 0; heap < all.memoryHeapCount; heap++) {
    if ((all.memoryHeaps[heap].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) == 0) continue;
    const std::uint64_t size = all.memoryHeaps[heap].size;
    const std::uint64_t left = has_budget ? std::min(size, budget.heapBudget[heap]) : size;
    capabilities.heap_budget = std::max(capabilities.heap_budget, left);
  }
}

using Needs = std::vector<std::pair<std::string_view, std::uint64_t>>;

// Which of the limits is too low; empty when none is.
std::string whatIsTooLow(const Capabilities& capabilities, const Needs& least) {
  for (const auto& [name, needed] : least) {
    const auto* const limit = std::ranges::find(known_limits, name, &NamedLimit::name);
    const std::uint64_t has = capabilities.*limit->member;
    if (has < needed) {
      return "its " + std::string(name) + " is " + std::to_string(has) + ", needed is " +
             std::to_string(needed);
    }
  }
  return {};
}

std::string whyNoGeometry(const Capabilities& capabilities) {
  if (!capabilities.geometry_shader) return "it lacks the feature geometryShader";
  if (!capabilities.vertex_pipeline_stores_and_atomics) {
    return "it lacks the feature vertexPipelineStoresAndAtomics";
  }
  return whatIsTooLow(
      capabilities, {{"maxTexelBufferElements", 256},
                     {"maxStorageBufferRange", answerRoom(EDGES_MOST, true) * sizeof(std::int32_t)},
                     {"maxGeometryOutputVertices", EDGES_MOST},
                     {"maxGeometryTotalOutputComponents", std::uint64_t{EDGES_MOST} * components_per_vertex},
                     {"maxImageDimension2D", 1},
                     {"maxFramebufferWidth", 1},
                     {"maxFramebufferHeight", 1},
                     {"subPixelPrecisionBits", least_subpixel_bits},
                     {"maxMemoryAllocationSize", least_memory},
                     {"heapBudget", least_memory}});
}

std::string whyNoCompute(const Capabilities& capabilities) {
  return whatIsTooLow(capabilities, {{"maxTexelBufferElements", 256},
                                     {"maxStorageBufferRange", std::uint64_t{EDGES_MOST} * vertex_bytes},
                                     {"maxImageDimension2D", 1},
                                     {"maxFramebufferWidth", 1},
                                     {"maxFramebufferHeight", 1},
                                     {"subPixelPrecisionBits", least_subpixel_bits},
                                     {"maxMemoryAllocationSize", least_memory},
                                     {"heapBudget", least_memory}});
}

// Why a pipeline cannot run, and what would help; empty when it can.
std::string whyNot(const Capabilities& capabilities, Pipeline pipeline) {
  if (pipeline == Pipeline::compute) {
    const std::string reason = whyNoCompute(capabilities);
    return reason.empty() ? reason : reason + ": use --backend cpu, or another --device";
  }
  const std::string reason = whyNoGeometry(capabilities);
  return reason.empty()
             ? reason
             : reason +
                   ": use --backend vulkan-compute, --backend opengl or --backend cpu, or another --device";
}

using Driver = VkPhysicalDeviceDriverProperties;

// Empty if the device does not report it.
Driver driverOf(VkPhysicalDevice device, bool says) {
  auto driver = structure<Driver>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
  if (!says) return driver;
  auto all = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  all.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device, &all);
  return driver;
}

std::string driverText(const Driver& driver, const VkPhysicalDeviceProperties& properties) {
  const std::uint32_t api = properties.apiVersion;
  const std::string version = "Vulkan " + std::to_string(VK_API_VERSION_MAJOR(api)) + "." +
                              std::to_string(VK_API_VERSION_MINOR(api)) + "." +
                              std::to_string(VK_API_VERSION_PATCH(api));
  if (driver.driverID == VkDriverId{}) {
    return version + ", driver " + std::to_string(properties.driverVersion);
  }
  return std::string(driver.driverName) + " " + driver.driverInfo + ", " + version;
}

Result<Physical> describe(VkPhysicalDevice handle, const Mask& mask, Pipeline pipeline) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(handle, &properties);
  VORPIPE_VAR(extensions, extensionsOf(handle));
  Physical device;
  device.handle = handle;
  device.capabilities = capabilitiesOf(handle, properties.limits);
  const bool current = properties.apiVersion >= VK_API_VERSION_1_1;
  const Driver driver =
      driverOf(handle, current && contains(extensions, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME));
  // Other drivers may take extremely long for unrolled shaders: decision D121.
  device.capabilities.unrolled_shaders = driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE;
  if (current) {
    askForMemory(handle, contains(extensions, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME), device.capabilities);
  }
  VORPIPE_TRY(applyMask(device.capabilities, mask));
  device.portability_subset = contains(extensions, "VK_KHR_portability_subset");
  device.swapchain = contains(extensions, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  device.info.backend = nameOf(pipeline);
  device.info.name = properties.deviceName;
  device.info.driver = driverText(driver, properties);
  device.info.type = typeName(properties.deviceType);
  device.info.features = listFeatures(device.capabilities);
  device.info.limits = listLimits(device.capabilities);
  const std::optional<std::uint32_t> family = graphicsFamily(handle);
  device.queue_family = family.value_or(0);
  if (!current) {
    device.info.reason = "it is older than Vulkan 1.1: update its driver";
  } else if (!family) {
    device.info.reason = "it has no graphics queue: use --backend cpu or another --device";
  } else {
    device.info.reason = whyNot(device.capabilities, pipeline);
  }
  device.info.usable = device.info.reason.empty();
  return device;
}

std::vector<const Physical*> candidates(std::span<const Physical> devices, std::string_view wanted) {
  std::vector<const Physical*> found;
  for (std::size_t index = 0; index < devices.size(); index++) {
    if (isIndexOrPartOf(wanted, index, devices[index].info.name)) found.push_back(&devices[index]);
  }
  return found;
}

std::string listed(std::span<const Physical> devices) {
  std::string list;
  for (std::size_t index = 0; index < devices.size(); index++) {
    list += (index == 0 ? "" : ", ") + std::to_string(index) + " '" + devices[index].info.name + "'";
  }
  return list;
}

}  // namespace

std::uint64_t mostOf(const Capabilities& capabilities, std::uint64_t bytes, std::uint64_t bytes_in_all) {
  return std::min(capabilities.max_memory_allocation_size / bytes,
                  capabilities.heap_budget / 2 / bytes_in_all);
}

std::uint64_t largestView(const Capabilities& capabilities) {
  constexpr std::uint64_t most = 4096;
  // Drivers round the sides of images up to less than that.
  constexpr std::uint64_t step = 64;
  const auto pixels = static_cast<double>(mostOf(capabilities, pixel_bytes, planes * pixel_bytes));
  const auto side = static_cast<std::uint64_t>(std::sqrt(pixels));
  return std::min({most, capabilities.max_framebuffer_width, capabilities.max_framebuffer_height,
                   capabilities.max_image_dimension_2d, side > step ? side / step * step : side});
}

std::string_view nameOf(Pipeline pipeline) {
  return pipeline == Pipeline::geometry ? "vulkan-geometry" : "vulkan-compute";
}

Result<std::vector<Physical>> enumerate(const Instance& instance, const Mask& mask, Pipeline pipeline) {
  std::uint32_t count = 0;
  VORPIPE_TRY(
      check(vkEnumeratePhysicalDevices(instance.handle(), &count, nullptr), "vkEnumeratePhysicalDevices"));
  std::vector<VkPhysicalDevice> handles(count);
  VORPIPE_TRY(check(vkEnumeratePhysicalDevices(instance.handle(), &count, handles.data()),
                    "vkEnumeratePhysicalDevices"));
  if (count == 0) {
    return deviceError(
        "no Vulkan device here: install mesa-vulkan-drivers (Debian/Ubuntu) or your GPU's driver, or use "
        "--backend cpu");
  }
  std::vector<Physical> devices;
  for (const VkPhysicalDevice handle : handles) {
    VORPIPE_VAR(device, describe(handle, mask, pipeline));
    devices.push_back(std::move(device));
  }
  return devices;
}

Result<Physical> choose(std::span<const Physical> devices, std::string_view wanted) {
  const std::vector<const Physical*> found = candidates(devices, wanted);
  if (found.empty()) {
    return deviceError("no Vulkan device '" + std::string(wanted) + "'; choose one of " + listed(devices));
  }
  const auto better = [](const Physical* a, const Physical* b) {
    const auto order = [](const Physical* device) {
      return std::pair(!device->info.usable, preference(device->info.type));
    };
    return order(a) < order(b);
  };
  const Physical& best = **std::ranges::min_element(found, better);
  if (best.info.usable) return best;
  return deviceError("the Vulkan device '" + best.info.name + "' cannot be used: " + best.info.reason);
}

}  // namespace vorpipe::vulkan
