/// The swapchain: images that a window shows in turn.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "backend/vulkan/handle.h"
#include "view/window/vulkan_window.h"

namespace vorpipe::view {

/// An image of the swapchain, to be filled.
struct WindowImage {
  VkImage image = VK_NULL_HANDLE;
  std::uint32_t index = 0;
  VkExtent2D extent{};              ///< the image's extent; the window may have changed already
  vulkan::Semaphores semaphores{};  ///< for the transfer commands that fill it
};

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
