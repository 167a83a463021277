#include "backend/vulkan/geometry.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>

#include "backend/view_uniform.h"
#include "backend/vulkan/arithmetic.h"
#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"

namespace vorpipe::vulkan {
namespace {

// The most that an upload and a batch may hold if the device sets no lower limit: 256 MiB of sites or lines,
// 16 MiB of statuses.
constexpr std::uint64_t most_texels = std::uint64_t{1} << 24;
constexpr std::uint64_t most_entries = std::uint64_t{1} << 22;
constexpr std::size_t status_bytes = sizeof(std::uint32_t);

// With its weight, its mark and its part of the bins, which are about half as many as sites.
constexpr std::uint64_t bytes_of_site = 48;
// With its mark and its status, there and on the host.
constexpr std::uint64_t bytes_of_entry = 64;

BackendInfo describe(const Physical& physical) {
  const Capabilities& can = physical.capabilities;
  BackendInfo info;
  info.device = physical.info;
  info.max_view = static_cast<int>(largestView(can));
  info.max_sites =
      std::min({most_texels, can.max_texel_buffer_elements, mostOf(can, sizeof(SiteTexel), bytes_of_site)});
  info.max_bins = info.max_sites - 1;
  info.max_lines = info.max_sites;
  info.max_entries =
      static_cast<std::uint32_t>(std::min({most_entries, can.max_storage_buffer_range / status_bytes,
                                           mostOf(can, sizeof(CellBatch<float>::Entry), bytes_of_entry)}));
  info.most_edges = EDGES_MOST;
  info.subpixel_bits = static_cast<int>(can.sub_pixel_precision_bits);
  return info;
}

}  // namespace

Result<std::unique_ptr<Backend>> GeometryBackend::open(Instance instance, const Physical& physical) {
  VORPIPE_VAR(device, Device::open(physical));
  VORPIPE_VAR(bindings, Bindings::create(device));
  VORPIPE_VAR(pipelines, Pipelines::create(device));
  std::unique_ptr<GeometryBackend> backend(new GeometryBackend(
      std::move(instance), std::move(device), std::move(bindings), std::move(pipelines), describe(physical)));
  // Shaders read the block of the view in cells() too, for which the caller sets none.
  VORPIPE_TRY(backend->setView(backend->shown_));
  return backend;
}

GeometryBackend::GeometryBackend(Instance instance, Device device, Bindings bindings, Pipelines pipelines,
                                 BackendInfo info)
    : instance_(std::move(instance)),
      device_(std::move(device)),
      bindings_(std::move(bindings)),
      pipelines_(std::move(pipelines)),
      info_(std::move(info)),
      view_({"the view", VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, Placement::upload}),
      palette_({"the palette", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload,
                VK_FORMAT_R8G8B8A8_UNORM}),
      entries_({"entries", VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, Placement::upload}),
      marks_({"marks", VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, Placement::upload}),
      lines_({"lines", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload,
              VK_FORMAT_R32G32B32A32_SFLOAT}),
      which_({"indices of sites", VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, Placement::upload}),
      status_({"statuses",
               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                   VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               Placement::device}),
      host_status_({"statuses", VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::download}),
      edges_({"edges", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::download}) {}

Result<void> GeometryBackend::upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) {
  VORPIPE_TRY(sites_.upload(device_, bindings_, sites, palette_index, info_));
  domain_ = sites.domain;
  return setView(shown_);
}

Result<void> GeometryBackend::setView(const View& view) {
  VORPIPE_TRY(view_.reserve(device_, sizeof(ViewUniform), sizeof(ViewUniform)));
  VORPIPE_TRY(palette_.reserve(device_, sizeof(Palette), sizeof(Palette)));
  shown_ = view;
  const ViewUniform block = viewUniform(view, info_.subpixel_bits, domain_);
  std::memcpy(view_.data(), &block, sizeof(block));
  std::memcpy(palette_.data(), view.palette.data(), sizeof(Palette));
  bindings_.setUniform(device_, BINDING_VIEW, view_.get());
  bindings_.setTexels(device_, BINDING_PALETTE, palette_.texels());
  return {};
}

Result<void> GeometryBackend::begin(const View& view) {
  assert(view.width >= 1 && view.width <= info_.max_view);
  assert(view.height >= 1 && view.height <= info_.max_view);
  VORPIPE_TRY(target_.resize(device_, pipelines_.targetPass(), static_cast<std::uint32_t>(view.width),
                             static_cast<std::uint32_t>(view.height)));
  VORPIPE_TRY(setView(view));
  return target_.clear(device_);
}

Result<void> GeometryBackend::reserveStatus(std::size_t entries) {
  assert(entries <= info_.max_entries);
  const std::size_t limit = info_.max_entries * status_bytes;
  VORPIPE_TRY(status_.reserve(device_, entries * status_bytes, limit));
  VORPIPE_TRY(host_status_.reserve(device_, entries * status_bytes, limit));
  bindings_.setStorage(device_, BINDING_STATUS, status_.get(), entries * status_bytes);
  return {};
}

// Runs a pipeline over the entries first .. first + count - 1 of those in the buffers. Their
// statuses are written to host_status_, from 0 on. All entries have one mark, or first is 0.
Result<void> GeometryBackend::run(const Pass& pass, std::size_t first, std::size_t count) {
  const VolkDeviceTable& api = device_.api();
  return device_.run([&](VkCommandBuffer commands) {
    static_assert(CELL_MISSING == 0);
    api.vkCmdFillBuffer(commands, status_.get(), 0, count * status_bytes, CELL_MISSING);
    auto order = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    order.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    order.dstAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    api.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_GEOMETRY_SHADER_BIT,
                             0, 1, &order, 0, nullptr, 0, nullptr);
    const VkRect2D area{{0, 0}, pass.extent};
    auto begin = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    begin.renderPass = pass.pass;
    begin.framebuffer = pass.framebuffer;
    begin.renderArea = area;
    api.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{
        0, 0, static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1};
    api.vkCmdSetViewport(commands, 0, 1, &viewport);
    api.vkCmdSetScissor(commands, 0, 1, &area);
    api.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pass.pipeline);
    const VkDescriptorSet set = bindings_.set();
    api.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, bindings_.layout(), 0, 1, &set, 0,
                                nullptr);
    const std::array<VkDeviceSize, 2> offsets = {first * pass.stride, 0};
    api.vkCmdBindVertexBuffers(commands, 0, 2, pass.vertices.data(), offsets.data());
    api.vkCmdDraw(commands, static_cast<std::uint32_t>(count), 1, 0, 0);
    api.vkCmdEndRenderPass(commands);
    order.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    order.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    api.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_GEOMETRY_SHADER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
                             0, 1, &order, 0, nullptr, 0, nullptr);
    const VkBufferCopy copy{0, 0, count * status_bytes};
    api.vkCmdCopyBuffer(commands, status_.get(), host_status_.get(), 1, &copy);
  });
}

Result<void> GeometryBackend::read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) {
  assert(target_.framebuffer() != VK_NULL_HANDLE);
  return target_.read(device_, rgba, ids);
}

// Uses a compute shader all the same: all stages of a device share their arithmetic.
Result<void> GeometryBackend::compute(std::span<const Operands> operands, std::span<Computed> out) {
  return vulkan::compute(device_, info_.max_entries * status_bytes, operands, out);
}

}  // namespace vorpipe::vulkan
