#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

#include "backend/vulkan/error.h"
#include "base/try.h"
#include "view/window/vulkan_canvas.h"
#include "view/window/vulkan_window.h"
#include "view/window/window_parts.h"

namespace vorpipe::view {
namespace {

// A window may change between acquiring an image and presenting it.
constexpr int most_tries = 2;

// The window's earlier use of an image does not matter: commands start after the window has released it.
constexpr vulkan::Use given_back{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TRANSFER_BIT, 0};
// The semaphore makes the writes visible to the window.
constexpr vulkan::Use given{VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0};

// Copies pixel by pixel from the top left; the order of channels may differ. If the window has grown
// meanwhile, the new area is black until the resize event arrives.
void recordCopy(const VolkDeviceTable& api, VkCommandBuffer commands, const VulkanCanvas& canvas,
                const WindowImage& window) {
  const std::array images = {window.image};
  vulkan::change(api, commands, images, given_back, vulkan::cleared);
  const VkExtent2D from = canvas.extent();
  if (window.extent.width > from.width || window.extent.height > from.height) {
    const VkClearColorValue black{};
    api.vkCmdClearColorImage(commands, window.image, vulkan::cleared.layout, &black, 1, &vulkan::whole_plane);
    vulkan::change(api, commands, images, vulkan::cleared, vulkan::cleared);
  }
  VkImageBlit blit{};
  blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  blit.dstSubresource = blit.srcSubresource;
  blit.srcOffsets[1] = {static_cast<std::int32_t>(std::min(from.width, window.extent.width)),
                        static_cast<std::int32_t>(std::min(from.height, window.extent.height)), 1};
  blit.dstOffsets[1] = blit.srcOffsets[1];
  api.vkCmdBlitImage(commands, canvas.image(), vulkan::copied.layout, window.image, vulkan::cleared.layout, 1,
                     &blit, VK_FILTER_NEAREST);
  vulkan::change(api, commands, images, vulkan::cleared, given);
}

class VulkanPresenter final : public Presenter {
 public:
  VulkanPresenter(VulkanWindow window, Swapchain swapchain, VulkanCanvas canvas)
      : window_(std::move(window)), swapchain_(std::move(swapchain)), canvas_(std::move(canvas)) {}
  VulkanPresenter(const VulkanPresenter&) = delete;
  VulkanPresenter& operator=(const VulkanPresenter&) = delete;
  // The window may still use the last image.
  ~VulkanPresenter() override { window_.device.api().vkDeviceWaitIdle(window_.device.handle()); }

  Result<void> setTexture(const PanelTexture& texture) override {
    return canvas_.setTexture(window_.device, texture);
  }

  Result<void> show(const Shown& frame, int width, int height) override {
    if (width <= 0 || height <= 0) return {};
    VORPIPE_TRY(canvas_.prepare(window_.device, frame, width, height));
    for (int tries = 0; tries < most_tries; ++tries) {
      VORPIPE_LET(image, swapchain_.acquire(window_, width, height));
      const vulkan::Semaphores semaphores = image ? image->semaphores : vulkan::Semaphores{};
      VORPIPE_TRY(window_.device.run(
          [&](VkCommandBuffer commands) {
            canvas_.record(window_.device.api(), commands);
            if (image) recordCopy(window_.device.api(), commands, canvas_, *image);
          },
          semaphores));
      canvas_.recorded();
      // A hidden window gets an event to show it when it reappears.
      if (!image) return {};
      VORPIPE_LET(shown, swapchain_.present(window_, *image));
      if (shown) return {};
    }
    // The new size will arrive as an event, followed by the next frame.
    return {};
  }

  Result<Image> read() override { return canvas_.read(window_.device); }

  [[nodiscard]] std::string name() const override { return "Vulkan on " + window_.physical.info.name; }

  std::vector<std::string> validationMessages() override { return window_.instance.messages().take(); }

 private:
  VulkanWindow window_;
  Swapchain swapchain_;
  VulkanCanvas canvas_;
};

}  // namespace

Result<std::unique_ptr<Presenter>> makeVulkanPresenter(const Glfw& glfw, GLFWwindow* window,
                                                       const std::string& device, bool validation) {
  VORPIPE_VAR(shows, VulkanWindow::open(glfw, window, device, validation));
  VORPIPE_VAR(swapchain, Swapchain::create(shows));
  VORPIPE_VAR(canvas, VulkanCanvas::create(shows.device));
  return std::make_unique<VulkanPresenter>(std::move(shows), std::move(swapchain), std::move(canvas));
}

}  // namespace vorpipe::view
