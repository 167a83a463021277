#include "backend/vulkan/target.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>
#include <vector>

#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"
#include "vorpipe.h"

namespace vorpipe::vulkan {
namespace {

VkAttachmentDescription attachment(VkFormat format) {
  VkAttachmentDescription description{};
  description.format = format;
  description.samples = VK_SAMPLE_COUNT_1_BIT;
  description.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  description.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  description.initialLayout = drawn.layout;
  description.finalLayout = drawn.layout;
  return description;
}

constexpr VkImageUsageFlags plane_usage =
    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

}  // namespace

Result<Handle<VkRenderPass>> createRenderPass(const Device& device, std::span<const VkFormat> formats) {
  std::vector<VkAttachmentDescription> attachments;
  std::vector<VkAttachmentReference> references;
  for (const VkFormat format : formats) {
    references.push_back({static_cast<std::uint32_t>(attachments.size()), drawn.layout});
    attachments.push_back(attachment(format));
  }
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = static_cast<std::uint32_t>(references.size());
  subpass.pColorAttachments = references.data();
  // After the clearing or drawing before, and before the drawing or copying after.
  std::array<VkSubpassDependency, 2> order{};
  order[0].srcSubpass = VK_SUBPASS_EXTERNAL;
  order[0].srcStageMask = drawn.stage | cleared.stage;
  order[0].dstStageMask = drawn.stage;
  order[0].srcAccessMask = drawn.access | cleared.access;
  order[0].dstAccessMask = drawn.access;
  order[1].dstSubpass = VK_SUBPASS_EXTERNAL;
  order[1].srcStageMask = drawn.stage;
  order[1].dstStageMask = drawn.stage | copied.stage;
  order[1].srcAccessMask = drawn.access;
  order[1].dstAccessMask = drawn.access | copied.access;
  auto info = structure<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
  info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = static_cast<std::uint32_t>(order.size());
  info.pDependencies = order.data();
  return create(device.handle(), device.api().vkCreateRenderPass, device.api().vkDestroyRenderPass, info,
                "vkCreateRenderPass");
}

std::size_t Target::planeBytes() const {
  return std::size_t{extent_.width} * extent_.height * sizeof(std::uint32_t);
}

Result<void> Target::resize(const Device& device, VkRenderPass pass, std::uint32_t width,
                            std::uint32_t height) {
  if (framebuffer_ && extent_.width == width && extent_.height == height) return {};
  extent_ = {width, height};
  framebuffer_ = {};
  color_ = {};
  id_ = {};
  for (const auto& [plane, format] : {std::pair(&color_, color_format), std::pair(&id_, id_format)}) {
    VORPIPE_VAR(created, createPlane(device, {format, plane_usage}, extent_));
    *plane = std::move(created);
  }
  VORPIPE_TRY(host_.reserve(device, planeBytes(), planeBytes()));
  const std::array views = {color_.view.get(), id_.view.get()};
  auto info = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
  info.renderPass = pass;
  info.attachmentCount = static_cast<std::uint32_t>(views.size());
  info.pAttachments = views.data();
  info.width = width;
  info.height = height;
  info.layers = 1;
  VORPIPE_VAR(framebuffer, create(device.handle(), device.api().vkCreateFramebuffer,
                                  device.api().vkDestroyFramebuffer, info, "vkCreateFramebuffer"));
  framebuffer_ = std::move(framebuffer);
  return {};
}

Result<void> Target::clear(Device& device) const {
  const VolkDeviceTable& api = device.api();
  const std::array images = {color_.image.get(), id_.image.get()};
  return device.run([&](VkCommandBuffer commands) {
    change(api, commands, images, forgotten, cleared);
    VkClearColorValue nothing{};
    api.vkCmdClearColorImage(commands, images[0], cleared.layout, &nothing, 1, &whole_plane);
    std::ranges::fill(nothing.uint32, no_site);
    api.vkCmdClearColorImage(commands, images[1], cleared.layout, &nothing, 1, &whole_plane);
    change(api, commands, images, cleared, drawn);
  });
}

Result<void> Target::read(Device& device, std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) {
  assert(rgba.size_bytes() == planeBytes() && ids.size_bytes() == planeBytes());
  VORPIPE_TRY(readPlane(device, color_, rgba));
  return readPlane(device, id_, ids);
}

// Planes are read one after the other through the same buffer, which thus takes no more memory than one
// image.
Result<void> Target::readPlane(Device& device, const Plane& plane, std::span<std::uint32_t> to) {
  const VolkDeviceTable& api = device.api();
  const std::array images = {plane.image.get()};
  VORPIPE_TRY(device.run([&](VkCommandBuffer commands) {
    change(api, commands, images, drawn, copied);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {extent_.width, extent_.height, 1};
    api.vkCmdCopyImageToBuffer(commands, images[0], copied.layout, host_.get(), 1, &copy);
    change(api, commands, images, copied, drawn);
  }));
  std::memcpy(to.data(), host_.data(), planeBytes());
  return {};
}

}  // namespace vorpipe::vulkan
