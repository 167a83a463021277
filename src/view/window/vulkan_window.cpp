#include "view/window/vulkan_window.h"

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "backend/vulkan/error.h"

namespace vorpipe::view {
namespace {

template <class Function>
void load(const vulkan::Instance& instance, const char* name, Function& function) {
  function = reinterpret_cast<Function>(vkGetInstanceProcAddr(instance.handle(), name));
}

Result<std::vector<vulkan::Physical>> devicesFor(const vulkan::Instance& instance,
                                                 const VulkanSurface& surface) {
  auto devices = vulkan::enumerate(instance, {}, vulkan::Pipeline::compute);
  if (!devices) return devices;
  for (vulkan::Physical& device : *devices) {
    VkBool32 supported = VK_FALSE;
    VORPIPE_TRY(
        vulkan::check(surface.support(device.handle, device.queue_family, surface.handle(), &supported),
                      "vkGetPhysicalDeviceSurfaceSupportKHR"));
    if (!device.info.usable || (device.swapchain && supported == VK_TRUE)) continue;
    device.info.usable = false;
    device.info.reason = "it cannot show anything in a window of this display";
  }
  return devices;
}

}  // namespace

Result<VulkanSurface> VulkanSurface::create(const Glfw& glfw, GLFWwindow* window,
                                            const vulkan::Instance& instance) {
  VulkanSurface created;
  load(instance, "vkGetPhysicalDeviceSurfaceSupportKHR", created.support);
  load(instance, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR", created.capabilities);
  load(instance, "vkGetPhysicalDeviceSurfaceFormatsKHR", created.formats);
  load(instance, "vkDestroySurfaceKHR", created.destroy_);
  created.instance_ = instance.handle();
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  const VkResult result = glfw.createWindowSurface(instance.handle(), window, nullptr, &surface);
  if (result != VK_SUCCESS) {
    return vulkan::deviceError("Vulkan cannot show anything in this window: " + glfw.lastError());
  }
  created.surface_ = surface;
  return created;
}

VulkanSurface::VulkanSurface(VulkanSurface&& other) noexcept
    : support(other.support),
      capabilities(other.capabilities),
      formats(other.formats),
      instance_(other.instance_),
      surface_(std::exchange(other.surface_, VK_NULL_HANDLE)),
      destroy_(other.destroy_) {}

VulkanSurface::~VulkanSurface() {
  if (surface_ != VK_NULL_HANDLE) destroy_(instance_, surface_, nullptr);
}

Result<VulkanWindow> VulkanWindow::open(const Glfw& glfw, GLFWwindow* window, const std::string& device,
                                        bool validation) {
  std::uint32_t count = 0;
  const char** const needed = glfw.getRequiredInstanceExtensions(&count);
  if (needed == nullptr) {
    // Without a loader or driver, the error says what to install; otherwise the display lacks something.
    auto instance = vulkan::Instance::open(false);
    if (!instance) return tl::unexpected(std::move(instance).error());
    return vulkan::deviceError("Vulkan cannot show anything on this display: " + glfw.lastError());
  }
  auto instance = vulkan::Instance::open(validation, std::span(needed, count));
  if (!instance) return tl::unexpected(std::move(instance).error());
  auto surface = VulkanSurface::create(glfw, window, *instance);
  if (!surface) return tl::unexpected(std::move(surface).error());
  const auto devices = devicesFor(*instance, *surface);
  if (!devices) return tl::unexpected(devices.error());
  auto physical = vulkan::choose(*devices, device);
  if (!physical) return tl::unexpected(std::move(physical).error());
  constexpr std::array extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  auto opened = vulkan::Device::open(*physical, extensions);
  if (!opened) return tl::unexpected(std::move(opened).error());
  return VulkanWindow{std::move(*instance), std::move(*surface), std::move(*physical), std::move(*opened)};
}

}  // namespace vorpipe::view
