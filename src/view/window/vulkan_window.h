/// A Vulkan device that can show images in a window, and its swapchain.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
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

/// The device of a window. The order of members destroys the device before the surface and the surface before
/// the instance.
struct VulkanWindow {
  vulkan::Instance instance;
  VulkanSurface surface;
  vulkan::Physical physical;
  vulkan::Device device;

  /// `device` is as in BackendOptions::device, among the devices that can present to this window.
  static Result<VulkanWindow> open(const Glfw& glfw, GLFWwindow* window, const std::string& device,
                                   bool validation);
};

/// An image of the swapchain, to be filled.
struct WindowImage {
  VkImage image = VK_NULL_HANDLE;
  std::uint32_t index = 0;
  VkExtent2D extent{};              ///< the image's extent; the window may have changed already
  vulkan::Semaphores semaphores{};  ///< for the transfer commands that fill it
};

/// The images that a window shows in turn.
class Swapchain {
 public:
  /// Errors (device): the window supports no format that colors can be copied to.
  static Result<Swapchain> create(const VulkanWindow& window);

  /// Returns the next image for a window of `width` x `height` pixels; none while the window has none or is
  /// hidden.
  Result<std::optional<WindowImage>> acquire(const VulkanWindow& window, int width, int height);

  /// Shows the image once the commands that fill it are done. Returns false, and shows nothing, if the window
  /// has changed.
  Result<bool> present(const VulkanWindow& window, const WindowImage& image);

 private:
  Result<void> recreate(const VulkanWindow& window, VkExtent2D asked);
  Result<void> takeImages(const VulkanWindow& window);

  VkSurfaceFormatKHR format_{};
  VkExtent2D asked_{}, extent_{};
  bool outdated_ = true;
  vulkan::Handle<VkSwapchainKHR> swapchain_;
  std::vector<VkImage> images_;
  vulkan::Handle<VkSemaphore> acquired_;
  /// One for each image: when an image is acquired again, the window has waited for its semaphore.
  std::vector<vulkan::Handle<VkSemaphore>> filled_;
};

}  // namespace vorpipe::view
