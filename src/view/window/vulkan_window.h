/// A Vulkan device that can show images in a window.
#pragma once

#include <string>

#include "backend/vulkan/device.h"
#include "backend/vulkan/instance.h"
#include "backend/vulkan/physical.h"
#include "view/window/glfw.h"

namespace vorpipe::view {

/// The Vulkan surface of a window. The instance outlives it.
class VulkanSurface {
 public:
  static Result<VulkanSurface> create(const Glfw& glfw, GLFWwindow* window, const vulkan::Instance& instance);
  VulkanSurface(VulkanSurface&& other) noexcept;
  VulkanSurface& operator=(VulkanSurface&&) = delete;
  ~VulkanSurface();

  [[nodiscard]] VkSurfaceKHR handle() const { return surface_; }

  // These belong to the instance with the extension; volk's belong to the instance opened last.
  PFN_vkGetPhysicalDeviceSurfaceSupportKHR support = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR capabilities = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceFormatsKHR formats = nullptr;

 private:
  VulkanSurface() = default;

  VkInstance instance_ = VK_NULL_HANDLE;
  VkSurfaceKHR surface_ = VK_NULL_HANDLE;
  PFN_vkDestroySurfaceKHR destroy_ = nullptr;
};

/// The order of members destroys the device before the surface and the surface before the instance.
struct VulkanWindow {
  vulkan::Instance instance;
  VulkanSurface surface;
  vulkan::Physical physical;
  vulkan::Device device;

  /// `device` is as in BackendOptions::device, among the devices that can present to this window.
  static Result<VulkanWindow> open(const Glfw& glfw, GLFWwindow* window, const std::string& device,
                                   bool validation);
};

}  // namespace vorpipe::view
