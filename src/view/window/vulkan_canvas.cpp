#include "view/window/vulkan_canvas.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <limits>
#include <utility>

#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "backend/vulkan/target.h"
#include "backend/vulkan/triangle_pipeline.h"
#include "base/try.h"
#include "shaders.h"

namespace vorpipe::view {
namespace {

using vulkan::color_format;
using vulkan::structure;

constexpr std::array canvas_formats = {color_format};
constexpr std::uint32_t surface_binding = 0;
constexpr std::array<VkDescriptorSetLayoutBinding, 1> bindings = {{
    {surface_binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr},
}};

constexpr VkVertexInputBindingDescription vertices{0, sizeof(PanelVertex), VK_VERTEX_INPUT_RATE_VERTEX};
constexpr std::array<VkVertexInputAttributeDescription, 3> vertex_attributes = {{
    {0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(PanelVertex, x)},
    {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(PanelVertex, u)},
    {2, 0, VK_FORMAT_A8B8G8R8_UNORM_PACK32, offsetof(PanelVertex, rgba)},
}};

// The canvas stays opaque.
constexpr std::array<VkPipelineColorBlendAttachmentState, 1> over = {
    {{VK_TRUE, VK_BLEND_FACTOR_SRC_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA, VK_BLEND_OP_ADD,
      VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA, VK_BLEND_OP_ADD,
      VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
          VK_COLOR_COMPONENT_A_BIT}}};

constexpr VkImageUsageFlags canvas_usage =
    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
constexpr VkImageUsageFlags texture_usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
// A texture after its last use, or new; its contents are replaced.
constexpr vulkan::Use replaced{VK_IMAGE_LAYOUT_UNDEFINED, vulkan::sampled.stage, 0};
// The canvas after it was last read, or new.
constexpr vulkan::Use shown_before{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TRANSFER_BIT, 0};

Result<vulkan::Handle<VkSampler>> createSampler(const vulkan::Device& device) {
  auto info = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
  info.magFilter = VK_FILTER_LINEAR;
  info.minFilter = VK_FILTER_LINEAR;
  info.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  return vulkan::create(device.handle(), device.api().vkCreateSampler, device.api().vkDestroySampler, info,
                        "vkCreateSampler");
}

std::size_t bytesOf(VkExtent2D extent) {
  return std::size_t{extent.width} * extent.height * sizeof(std::uint32_t);
}

VkExtent2D extentOf(int width, int height) {
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

bool same(VkExtent2D a, VkExtent2D b) { return a.width == b.width && a.height == b.height; }

VkBufferImageCopy wholeOf(VkExtent2D extent) {
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {extent.width, extent.height, 1};
  return copy;
}

void recordTexture(const VolkDeviceTable& api, VkCommandBuffer commands, VkBuffer from, VkImage to,
                   VkExtent2D extent) {
  const std::array images = {to};
  vulkan::change(api, commands, images, replaced, vulkan::cleared);
  const VkBufferImageCopy copy = wholeOf(extent);
  api.vkCmdCopyBufferToImage(commands, from, to, vulkan::cleared.layout, 1, &copy);
  vulkan::change(api, commands, images, vulkan::cleared, vulkan::sampled);
}

template <class T>
Result<void> store(Result<T> created, T& to) {
  if (!created) return tl::unexpected(std::move(created).error());
  to = std::move(*created);
  return {};
}

template <class T>
Result<void> write(const vulkan::Device& device, const std::vector<T>& values, vulkan::Buffer& buffer) {
  const std::size_t bytes = values.size() * sizeof(T);
  VORPIPE_TRY(buffer.reserve(device, bytes, std::numeric_limits<std::size_t>::max()));
  if (bytes > 0) std::memcpy(buffer.data(), values.data(), bytes);
  return {};
}

}  // namespace

Result<VulkanCanvas> VulkanCanvas::create(const vulkan::Device& device) {
  VORPIPE_VAR(picture, vulkan::Bindings::create(device, bindings, 0));
  VORPIPE_VAR(panel, vulkan::Bindings::create(device, bindings, 0));
  VulkanCanvas created(std::move(picture), std::move(panel));
  VORPIPE_TRY(store(vulkan::createRenderPass(device, canvas_formats), created.pass_));
  VORPIPE_TRY(store(createSampler(device), created.sampler_));
  // Both sets of bindings have the same layout.
  VORPIPE_TRY(store(vulkan::createTrianglePipeline(
                        device, created.panel_bindings_.layout(), created.pass_.get(),
                        {shaders::panel_vert(), shaders::panel_frag(), vertices, vertex_attributes, over}),
                    created.pipeline_));
  return created;
}

Result<void> VulkanCanvas::setTexture(vulkan::Device& device, const PanelTexture& texture) {
  assert(texture.alpha.size() ==
         static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height));
  constexpr VkComponentMapping white = {VK_COMPONENT_SWIZZLE_ONE, VK_COMPONENT_SWIZZLE_ONE,
                                        VK_COMPONENT_SWIZZLE_ONE, VK_COMPONENT_SWIZZLE_R};
  const VkExtent2D extent = extentOf(texture.width, texture.height);
  VORPIPE_TRY(
      store(vulkan::createPlane(device, {VK_FORMAT_R8_UNORM, texture_usage, white}, extent), panel_texture_));
  vulkan::Buffer texels({"the panel's letters", VK_BUFFER_USAGE_TRANSFER_SRC_BIT, vulkan::Placement::upload});
  VORPIPE_TRY(write(device, texture.alpha, texels));
  VORPIPE_TRY(device.run([&](VkCommandBuffer commands) {
    recordTexture(device.api(), commands, texels.get(), panel_texture_.image.get(), extent);
  }));
  panel_bindings_.setSampled(device, surface_binding, sampler_.get(), panel_texture_.view.get());
  return {};
}

Result<void> VulkanCanvas::resize(const vulkan::Device& device, VkExtent2D extent) {
  if (framebuffer_ && same(extent, extent_)) return {};
  framebuffer_ = {};
  canvas_ = {};
  drawn_ = false;
  VORPIPE_TRY(store(vulkan::createPlane(device, {color_format, canvas_usage}, extent), canvas_));
  extent_ = extent;
  const VkImageView view = canvas_.view.get();
  auto info = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
  info.renderPass = pass_.get();
  info.attachmentCount = 1;
  info.pAttachments = &view;
  info.width = extent.width;
  info.height = extent.height;
  info.layers = 1;
  VORPIPE_TRY(store(vulkan::create(device.handle(), device.api().vkCreateFramebuffer,
                                   device.api().vkDestroyFramebuffer, info, "vkCreateFramebuffer"),
                    framebuffer_));
  return {};
}

Result<void> VulkanCanvas::takePicture(const vulkan::Device& device, const Shown& frame) {
  const Image& picture = *frame.picture;
  if (version_ != frame.version) {
    version_.reset();
    picture_extent_ = extentOf(picture.width, picture.height);
    const std::size_t bytes = bytesOf(picture_extent_);
    VORPIPE_TRY(pixels_.reserve(device, bytes, bytes));
    putOverBackground(picture, {reinterpret_cast<std::uint32_t*>(pixels_.data()), picture.rgba.size()});
    version_ = frame.version;
  }
  if (sharp_ || texture_version_ == version_ ||
      (picture_texture_.image && same(picture_extent_, texture_extent_))) {
    return {};
  }
  picture_texture_ = {};
  VORPIPE_TRY(
      store(vulkan::createPlane(device, {color_format, texture_usage}, picture_extent_), picture_texture_));
  texture_extent_ = picture_extent_;
  texture_version_.reset();
  picture_bindings_.setSampled(device, surface_binding, sampler_.get(), picture_texture_.view.get());
  return {};
}

Result<void> VulkanCanvas::prepare(const vulkan::Device& device, const Shown& frame, int width, int height) {
  VORPIPE_TRY(resize(device, extentOf(width, height)));
  sharp_ = isSharp(frame, width, height);
  if (hasPicture(frame)) VORPIPE_TRY(takePicture(device, frame));
  triangles_ = trianglesOf(frame, width, height);
  VORPIPE_TRY(write(device, triangles_.vertices, vertices_));
  return write(device, triangles_.indices, indices_);
}

void VulkanCanvas::recordPicture(const VolkDeviceTable& api, VkCommandBuffer commands) const {
  const std::array images = {canvas_.image.get()};
  vulkan::change(api, commands, images, shown_before, vulkan::cleared);
  if (sharp_) {
    const VkBufferImageCopy copy = wholeOf(extent_);
    api.vkCmdCopyBufferToImage(commands, pixels_.get(), images[0], vulkan::cleared.layout, 1, &copy);
  } else {
    const auto channel = [](int shift) { return static_cast<float>((background >> shift) & 0xFFU) / 255.0F; };
    const VkClearColorValue color = {{channel(0), channel(8), channel(16), channel(24)}};
    api.vkCmdClearColorImage(commands, images[0], vulkan::cleared.layout, &color, 1, &vulkan::whole_plane);
  }
  vulkan::change(api, commands, images, vulkan::cleared, vulkan::drawn);
}

void VulkanCanvas::recordTriangles(const VolkDeviceTable& api, VkCommandBuffer commands) const {
  auto begin = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
  begin.renderPass = pass_.get();
  begin.framebuffer = framebuffer_.get();
  begin.renderArea = {{0, 0}, extent_};
  api.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  api.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
  const VkViewport viewport{0, 0, static_cast<float>(extent_.width), static_cast<float>(extent_.height),
                            0, 1};
  api.vkCmdSetViewport(commands, 0, 1, &viewport);
  const VkBuffer buffer = vertices_.get();
  const VkDeviceSize start = 0;
  api.vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &start);
  api.vkCmdBindIndexBuffer(commands, indices_.get(), 0, VK_INDEX_TYPE_UINT32);
  for (const TrianglePart& part : triangles_.parts) {
    assert(part.surface == Surface::picture || panel_texture_.image);  // setTexture() comes first
    const vulkan::Bindings& used = part.surface == Surface::picture ? picture_bindings_ : panel_bindings_;
    const VkDescriptorSet set = used.set();
    api.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, used.layout(), 0, 1, &set, 0,
                                nullptr);
    const VkRect2D area{{part.left, part.top}, extentOf(part.width, part.height)};
    api.vkCmdSetScissor(commands, 0, 1, &area);
    api.vkCmdDrawIndexed(commands, part.indices, 1, part.first_index, 0, 0);
  }
  api.vkCmdEndRenderPass(commands);
}

void VulkanCanvas::record(const VolkDeviceTable& api, VkCommandBuffer commands) const {
  const bool textured = !triangles_.parts.empty() && triangles_.parts.front().surface == Surface::picture;
  if (textured && texture_version_ != version_) {
    recordTexture(api, commands, pixels_.get(), picture_texture_.image.get(), picture_extent_);
  }
  recordPicture(api, commands);
  if (!triangles_.parts.empty()) recordTriangles(api, commands);
  const std::array images = {canvas_.image.get()};
  vulkan::change(api, commands, images, vulkan::drawn, vulkan::copied);
}

void VulkanCanvas::recorded() {
  if (!triangles_.parts.empty() && triangles_.parts.front().surface == Surface::picture)
    texture_version_ = version_;
  drawn_ = true;
}

Result<Image> VulkanCanvas::read(vulkan::Device& device) {
  if (!drawn_) return vulkan::deviceError("the window shows nothing that could be read");
  VORPIPE_TRY(host_.reserve(device, bytesOf(extent_), bytesOf(extent_)));
  VORPIPE_TRY(device.run([&](VkCommandBuffer commands) {
    const VkBufferImageCopy copy = wholeOf(extent_);
    device.api().vkCmdCopyImageToBuffer(commands, image(), vulkan::copied.layout, host_.get(), 1, &copy);
  }));
  Image shown;
  shown.width = static_cast<int>(extent_.width);
  shown.height = static_cast<int>(extent_.height);
  shown.rgba.resize(std::size_t{extent_.width} * extent_.height);
  std::memcpy(shown.rgba.data(), host_.data(), bytesOf(extent_));
  return shown;
}

}  // namespace vorpipe::view
