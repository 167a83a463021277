#include "backend/vulkan/memory/target.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>

#include "backend/vulkan/device/error.h"
#include "backend/vulkan/device/structure.h"
#include "vorpipe.h"

namespace vorpipe::vulkan {
namespace {

constexpr VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

struct Use {
  VkImageLayout layout;
  VkPipelineStageFlags stage;
  VkAccessFlags access;
};

constexpr Use drawn{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                    VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
constexpr Use cleared{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                      VK_ACCESS_TRANSFER_WRITE_BIT};
constexpr Use copied{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                     VK_ACCESS_TRANSFER_READ_BIT};
constexpr Use forgotten{VK_IMAGE_LAYOUT_UNDEFINED, drawn.stage, drawn.access};

template <std::size_t count>
void change(const VolkDeviceTable& api, VkCommandBuffer commands, const std::array<VkImage, count>& images,
            const Use& from, const Use& to) {
  std::array<VkImageMemoryBarrier, count> barriers{};
  for (std::size_t k = 0; k < images.size(); k++) {
    barriers[k].sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barriers[k].srcAccessMask = from.access;
    barriers[k].dstAccessMask = to.access;
    barriers[k].oldLayout = from.layout;
    barriers[k].newLayout = to.layout;
    barriers[k].srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barriers[k].dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barriers[k].image = images[k];
    barriers[k].subresourceRange = whole;
  }
  api.vkCmdPipelineBarrier(commands, from.stage, to.stage, 0, 0, nullptr, 0, nullptr,
                           static_cast<std::uint32_t>(barriers.size()), barriers.data());
}

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

}  // namespace

Result<Handle<VkRenderPass>> createRenderPass(const Device& device) {
  const std::array attachments = {attachment(color_format), attachment(id_format)};
  const std::array references = {VkAttachmentReference{0, drawn.layout},
                                 VkAttachmentReference{1, drawn.layout}};
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

Result<Target::Plane> Target::createPlane(const Device& device, VkFormat format, VkExtent2D extent) {
  const VolkDeviceTable& api = device.api();
  auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {extent.width, extent.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage =
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  Result<Handle<VkImage>> image =
      create(device.handle(), api.vkCreateImage, api.vkDestroyImage, info, "vkCreateImage");
  if (!image) return tl::unexpected(std::move(image).error());
  VkMemoryRequirements needed{};
  api.vkGetImageMemoryRequirements(device.handle(), image->get(), &needed);
  Result<Handle<VkDeviceMemory>> memory = allocate(device, needed, Placement::device, "an image");
  if (!memory) return tl::unexpected(std::move(memory).error());
  Plane plane;
  plane.memory = std::move(*memory);
  plane.image = std::move(*image);
  VORPIPE_TRY(check(api.vkBindImageMemory(device.handle(), plane.image.get(), plane.memory.get(), 0),
                    "vkBindImageMemory"));
  auto view_info = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view_info.image = plane.image.get();
  view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view_info.format = format;
  view_info.subresourceRange = whole;
  Result<Handle<VkImageView>> view =
      create(device.handle(), api.vkCreateImageView, api.vkDestroyImageView, view_info, "vkCreateImageView");
  if (!view) return tl::unexpected(std::move(view).error());
  plane.view = std::move(*view);
  return plane;
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
    Result<Plane> created = createPlane(device, format, extent_);
    if (!created) return tl::unexpected(std::move(created).error());
    *plane = std::move(*created);
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
  Result<Handle<VkFramebuffer>> framebuffer =
      create(device.handle(), device.api().vkCreateFramebuffer, device.api().vkDestroyFramebuffer, info,
             "vkCreateFramebuffer");
  if (!framebuffer) return tl::unexpected(std::move(framebuffer).error());
  framebuffer_ = std::move(*framebuffer);
  return {};
}

Result<void> Target::clear(Device& device) const {
  const VolkDeviceTable& api = device.api();
  const std::array images = {color_.image.get(), id_.image.get()};
  return device.run([&](VkCommandBuffer commands) {
    change(api, commands, images, forgotten, cleared);
    VkClearColorValue nothing{};
    api.vkCmdClearColorImage(commands, images[0], cleared.layout, &nothing, 1, &whole);
    std::ranges::fill(nothing.uint32, no_site);
    api.vkCmdClearColorImage(commands, images[1], cleared.layout, &nothing, 1, &whole);
    change(api, commands, images, cleared, drawn);
  });
}

Result<void> Target::read(Device& device, std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) {
  assert(rgba.size_bytes() == planeBytes() && ids.size_bytes() == planeBytes());
  VORPIPE_TRY(readPlane(device, color_, rgba));
  return readPlane(device, id_, ids);
}

// One after the other by the same way, which so takes no more memory than an image.
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
