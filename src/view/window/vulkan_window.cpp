#include "view/window/vulkan_window.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"

namespace vorpipe::view {
namespace {

using vulkan::check;
using vulkan::structure;

// A window may change again while its images are recreated.
constexpr int most_recreations = 3;
// Some desktops provide no image while a window is hidden.
constexpr std::uint64_t longest_wait = 500'000'000;  // nanoseconds

Result<vulkan::Handle<VkSemaphore>> createSemaphore(const vulkan::Device& device) {
  const auto info = structure<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
  return vulkan::create(device.handle(), device.api().vkCreateSemaphore, device.api().vkDestroySemaphore,
                        info, "vkCreateSemaphore");
}

// Colors are copied unchanged, so formats that convert from linear light are unsuitable.
Result<VkSurfaceFormatKHR> chooseFormat(const VulkanWindow& window) {
  std::uint32_t count = 0;
  const VkSurfaceKHR surface = window.surface.handle();
  VORPIPE_TRY(check(window.surface.formats(window.physical.handle, surface, &count, nullptr),
                    "vkGetPhysicalDeviceSurfaceFormatsKHR"));
  std::vector<VkSurfaceFormatKHR> formats(count);
  VORPIPE_TRY(check(window.surface.formats(window.physical.handle, surface, &count, formats.data()),
                    "vkGetPhysicalDeviceSurfaceFormatsKHR"));
  constexpr std::array wanted = {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM,
                                 VK_FORMAT_A8B8G8R8_UNORM_PACK32};
  for (const VkFormat format : wanted) {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(window.physical.handle, format, &properties);
    if ((properties.optimalTilingFeatures & VK_FORMAT_FEATURE_BLIT_DST_BIT) == 0) continue;
    const auto found = std::ranges::find_if(formats, [&](const VkSurfaceFormatKHR& has) {
      return has.format == format && has.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    });
    if (found != formats.end()) return *found;
  }
  return vulkan::deviceError("'" + window.physical.info.name +
                             "' offers windows no format of 8 bits a channel that it can copy to");
}

// The contents are opaque, so any known mode gives the same result.
VkCompositeAlphaFlagBitsKHR compositeAlpha(VkCompositeAlphaFlagsKHR supported) {
  constexpr std::array<VkCompositeAlphaFlagsKHR, 4> known = {
      VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
      VK_COMPOSITE_ALPHA_POST_MULTIPLIED_BIT_KHR, VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR};
  for (const VkCompositeAlphaFlagsKHR bit : known) {
    if ((supported & bit) != 0) return static_cast<VkCompositeAlphaFlagBitsKHR>(bit);
  }
  return VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
}

// The window's own size; if it has none, as under Wayland, the images determine it.
VkExtent2D extentOf(const VkSurfaceCapabilitiesKHR& window, VkExtent2D asked) {
  if (window.currentExtent.width != std::numeric_limits<std::uint32_t>::max()) return window.currentExtent;
  return {std::clamp(asked.width, window.minImageExtent.width, window.maxImageExtent.width),
          std::clamp(asked.height, window.minImageExtent.height, window.maxImageExtent.height)};
}

template <class Function>
void loadFunction(const vulkan::Instance& instance, const char* name, Function& function) {
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
  loadFunction(instance, "vkGetPhysicalDeviceSurfaceSupportKHR", created.support);
  loadFunction(instance, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR", created.capabilities);
  loadFunction(instance, "vkGetPhysicalDeviceSurfaceFormatsKHR", created.formats);
  loadFunction(instance, "vkDestroySurfaceKHR", created.destroy_);
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
  VORPIPE_VAR(instance, vulkan::Instance::open(validation, std::span(needed, count)));
  VORPIPE_VAR(surface, VulkanSurface::create(glfw, window, instance));
  VORPIPE_LET(devices, devicesFor(instance, surface));
  VORPIPE_VAR(physical, vulkan::choose(devices, device));
  constexpr std::array extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  VORPIPE_VAR(opened, vulkan::Device::open(physical, extensions));
  return VulkanWindow{std::move(instance), std::move(surface), std::move(physical), std::move(opened)};
}

Result<Swapchain> Swapchain::create(const VulkanWindow& window) {
  Swapchain created;
  VORPIPE_LET(format, chooseFormat(window));
  created.format_ = format;
  VORPIPE_VAR(acquired, createSemaphore(window.device));
  created.acquired_ = std::move(acquired);
  return created;
}

Result<void> Swapchain::recreate(const VulkanWindow& window, VkExtent2D asked) {
  const vulkan::Device& device = window.device;
  VkSurfaceCapabilitiesKHR surface{};
  VORPIPE_TRY(check(window.surface.capabilities(window.physical.handle, window.surface.handle(), &surface),
                    "vkGetPhysicalDeviceSurfaceCapabilitiesKHR"));
  // The window may not have waited yet for the semaphores of presented images.
  VORPIPE_TRY(check(device.api().vkDeviceWaitIdle(device.handle()), "vkDeviceWaitIdle"));
  filled_.clear();
  images_.clear();
  asked_ = asked;
  extent_ = extentOf(surface, asked);
  const vulkan::Handle<VkSwapchainKHR> old = std::move(swapchain_);
  swapchain_ = {};
  if (extent_.width == 0 || extent_.height == 0) return {};
  auto info = structure<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
  info.surface = window.surface.handle();
  info.minImageCount = surface.minImageCount;
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = extent_;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = surface.currentTransform;
  info.compositeAlpha = compositeAlpha(surface.supportedCompositeAlpha);
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  info.clipped = VK_TRUE;
  info.oldSwapchain = old.get();
  VORPIPE_VAR(swapchain, vulkan::create(device.handle(), device.api().vkCreateSwapchainKHR,
                                        device.api().vkDestroySwapchainKHR, info, "vkCreateSwapchainKHR"));
  swapchain_ = std::move(swapchain);
  VORPIPE_TRY(takeImages(window));
  outdated_ = false;
  return {};
}

Result<void> Swapchain::takeImages(const VulkanWindow& window) {
  const vulkan::Device& device = window.device;
  std::uint32_t count = 0;
  VORPIPE_TRY(check(device.api().vkGetSwapchainImagesKHR(device.handle(), swapchain_.get(), &count, nullptr),
                    "vkGetSwapchainImagesKHR"));
  images_.resize(count);
  VORPIPE_TRY(
      check(device.api().vkGetSwapchainImagesKHR(device.handle(), swapchain_.get(), &count, images_.data()),
            "vkGetSwapchainImagesKHR"));
  for (std::uint32_t index = 0; index < count; ++index) {
    VORPIPE_VAR(semaphore, createSemaphore(device));
    filled_.push_back(std::move(semaphore));
  }
  return {};
}

Result<std::optional<WindowImage>> Swapchain::acquire(const VulkanWindow& window, int width, int height) {
  const vulkan::Device& device = window.device;
  const VkExtent2D asked{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  for (int tries = 0; tries < most_recreations; ++tries) {
    if (outdated_ || !swapchain_ || asked.width != asked_.width || asked.height != asked_.height) {
      VORPIPE_TRY(recreate(window, asked));
    }
    if (!swapchain_) return std::nullopt;
    std::uint32_t index = 0;
    const VkResult result = device.api().vkAcquireNextImageKHR(
        device.handle(), swapchain_.get(), longest_wait, acquired_.get(), VK_NULL_HANDLE, &index);
    if (result == VK_TIMEOUT || result == VK_NOT_READY) return std::nullopt;
    outdated_ = result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR;
    if (result == VK_ERROR_OUT_OF_DATE_KHR) continue;
    if (result != VK_SUBOPTIMAL_KHR) VORPIPE_TRY(check(result, "vkAcquireNextImageKHR"));
    return WindowImage{images_[index],
                       index,
                       extent_,
                       {acquired_.get(), VK_PIPELINE_STAGE_TRANSFER_BIT, filled_[index].get()}};
  }
  return std::nullopt;
}

Result<bool> Swapchain::present(const VulkanWindow& window, const WindowImage& image) {
  const VkSwapchainKHR swapchain = swapchain_.get();
  auto info = structure<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &image.semaphores.after;
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain;
  info.pImageIndices = &image.index;
  const VkResult result = window.device.api().vkQueuePresentKHR(window.device.queue(), &info);
  if (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR) {
    outdated_ = true;
    return result == VK_SUBOPTIMAL_KHR;
  }
  VORPIPE_TRY(check(result, "vkQueuePresentKHR"));
  return true;
}

}  // namespace vorpipe::view
