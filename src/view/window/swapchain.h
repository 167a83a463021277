/// The images that a window shows in turn.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "backend/vulkan/handle.h"
#include "view/window/vulkan_window.h"

namespace vorpipe::view {

/// One of them, to be filled.
struct WindowImage {
  VkImage image = VK_NULL_HANDLE;
  std::uint32_t index = 0;
  VkExtent2D extent{};              ///< the window's own, which may have changed already
  vulkan::Semaphores semaphores{};  ///< for the commands that fill it, by transfer
};

class Swapchain {
 public:
  /// Errors (device): the window takes no format that colors can be copied to.
  static Result<Swapchain> create(const VulkanWindow& window);

  /// The next image for a window of `width` x `height` pixels; none while the window has none or is hidden.
  Result<std::optional<WindowImage>> acquire(const VulkanWindow& window, int width, int height);

  /// Shows it, once the commands are done that were to fill it. False: the window has changed, and nothing is
  /// shown.
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
  /// One for each image: of an image that comes back it is known that the window has waited for it.
  std::vector<vulkan::Handle<VkSemaphore>> filled_;
};

}  // namespace vorpipe::view
