#include "backend/vulkan/compute.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <span>
#include <utility>

#include "backend/site_texels.h"
#include "backend/to_float.h"
#include "backend/view_uniform.h"
#include "backend/vulkan/arithmetic.h"
#include "backend/vulkan/error.h"
#include "base/try.h"

namespace vorpipe::vulkan {
namespace {

// The most that a call may hold where the device sets no lower limit: 1 GiB of sites, 256 MiB of lines.
constexpr std::uint64_t most_sites = std::uint64_t{1} << 26;
constexpr std::uint64_t most_lines = std::uint64_t{1} << 24;
constexpr std::uint64_t most_entries = std::uint64_t{1} << 22;
// Device memory for a site that the host sorted into bins: its texel, weight, mark and share of the bins,
// which are half as many as sites. For one that the device sorts, also its part of SortedSites' buffers.
constexpr std::uint64_t bytes_of_site = 48;
constexpr std::uint64_t bytes_of_sorted_site = 80;
// Device memory for an entry and its mark.
constexpr std::uint64_t bytes_of_entry = 48;

using Entry = CellBatch<float>::Entry;
static_assert(sizeof(Entry) == 8 * sizeof(float));
static_assert(sizeof(DrawMark) == 4 * sizeof(float));
constexpr std::size_t line_bytes = sizeof(HalfPlane<float>);

constexpr VkShaderStageFlags compute = VK_SHADER_STAGE_COMPUTE_BIT;

// Four storage buffers, which every device has.
constexpr std::array<VkDescriptorSetLayoutBinding, 14> clip_bindings = {{
    {BINDING_VIEW, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, compute, nullptr},
    {BINDING_GRID, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, compute, nullptr},
    {BINDING_LINES, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, compute, nullptr},
    {BINDING_SITES, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, compute, nullptr},
    {BINDING_BINS, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, compute, nullptr},
    {BINDING_MARKS, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, compute, nullptr},
    {BINDING_RANK_OF_SITE, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, compute, nullptr},
    {BINDING_SITE_OF_RANK, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, compute, nullptr},
    {BINDING_WEIGHTS, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, compute, nullptr},
    {BINDING_HEAVIEST, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, compute, nullptr},
    {BINDING_ENTRIES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, compute, nullptr},
    {BINDING_STATUS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, compute, nullptr},
    {BINDING_VERTICES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, compute, nullptr},
    {BINDING_COUNTS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, compute, nullptr},
}};

BackendInfo describe(const Physical& physical, SiteSorter sorter) {
  const Capabilities& can = physical.capabilities;
  BackendInfo info;
  info.device = physical.info;
  info.max_view = static_cast<int>(largestView(can));
  const bool by_device = sorter == SiteSorter::device;
  info.max_sites =
      std::min({most_sites, can.max_texel_buffer_elements,
                mostOf(can, sizeof(SiteTexel), by_device ? bytes_of_sorted_site : bytes_of_site)});
  // n bins take n + 1 texels; their heaviest weights, four to a texel, take fewer.
  info.max_bins = std::min(info.max_sites, can.max_texel_buffer_elements - 1);
  if (by_device) {
    info.max_sites = std::min(info.max_sites, can.max_storage_buffer_range / sizeof(SiteTexel));
    info.max_bins = std::min(info.max_bins, can.max_storage_buffer_range / sizeof(std::uint32_t) - 1);
  }
  info.max_lines = std::min({most_lines, can.max_texel_buffer_elements, mostOf(can, line_bytes, line_bytes)});
  info.max_entries = static_cast<std::uint32_t>(
      std::min({most_entries, can.max_storage_buffer_range / sizeof(Entry), can.max_texel_buffer_elements,
                mostOf(can, sizeof(Entry), bytes_of_entry)}));
  info.most_edges = EDGES_MOST;
  info.subpixel_bits = static_cast<int>(can.sub_pixel_precision_bits);
  return info;
}

}  // namespace

Result<std::unique_ptr<Backend>> ComputeBackend::open(Instance instance, const Physical& physical,
                                                      SiteSorter sorter) {
  VORPIPE_VAR(device, Device::open(physical));
  VORPIPE_VAR(sites, Bindings::create(device, clip_bindings, sizeof(Slice)));
  VORPIPE_VAR(lists, Bindings::create(device, clip_bindings, sizeof(Slice)));
  std::optional<SortedSites> sorted;
  if (sorter == SiteSorter::device) {
    VORPIPE_VAR(created, SortedSites::create(device));
    sorted = std::move(created);
  }
  VORPIPE_VAR(kernels, ComputeKernels::create(device));
  VORPIPE_VAR(triangles, TriangleList::create(device));
  VORPIPE_VAR(painter, Painter::create(device));
  std::unique_ptr<ComputeBackend> backend(
      new ComputeBackend({std::move(instance), std::move(device), std::move(sites), std::move(lists),
                          std::move(sorted), std::move(kernels), std::move(triangles), std::move(painter)},
                         describe(physical, sorter),
                         std::min(physical.capabilities.max_storage_buffer_range,
                                  physical.capabilities.max_memory_allocation_size)));
  return backend;
}

ComputeBackend::ComputeBackend(Parts parts, BackendInfo info, std::uint64_t storage_range)
    : instance_(std::move(parts.instance)),
      device_(std::move(parts.device)),
      sites_bindings_(std::move(parts.sites)),
      lists_bindings_(std::move(parts.lists)),
      kernels_(std::move(parts.kernels)),
      triangles_(std::move(parts.triangles)),
      painter_(std::move(parts.painter)),
      info_(std::move(info)),
      storage_range_(storage_range),
      sorted_(std::move(parts.sorted)),
      view_({"the view", VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, Placement::upload}),
      entries_({"entries", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::upload}),
      lines_({"lines", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload,
              VK_FORMAT_R32G32B32A32_SFLOAT}),
      marks_({"marks", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, Placement::upload,
              VK_FORMAT_R32G32B32A32_UINT}),
      answers_({"answers", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                Placement::download}),
      vertices_({"vertices", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                 Placement::device}) {}

Result<void> ComputeBackend::upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) {
  weighted_ = !sites.weight.empty();
  // Searches need the indices of the heavy sites after sorting, which only the host knows.
  sorted_here_ = sorted_.has_value() && !weighted_;
  if (sorted_here_) {
    VORPIPE_TRY(sorted_->upload(device_, sites_bindings_, sites, palette_index, info_));
  } else {
    VORPIPE_TRY(sites_.upload(device_, sites_bindings_, sites, palette_index, info_));
    // The kernels declare these two and do not read them, but a set needs something bound to each.
    for (const auto unread : std::array<std::uint32_t, 2>{BINDING_RANK_OF_SITE, BINDING_SITE_OF_RANK}) {
      sites_bindings_.setTexels(device_, unread, sites_.bins());
    }
  }
  domain_ = sites.domain;
  return setView(shown_);
}

Result<void> ComputeBackend::setView(const View& view) {
  VORPIPE_TRY(view_.reserve(device_, sizeof(ViewUniform), sizeof(ViewUniform)));
  shown_ = view;
  const ViewUniform block = viewUniform(view, info_.subpixel_bits, domain_);
  std::memcpy(view_.data(), &block, sizeof(block));
  sites_bindings_.setUniform(device_, BINDING_VIEW, view_.get());
  lists_bindings_.setUniform(device_, BINDING_VIEW, view_.get());
  return painter_.setPalette(device_, view.palette);
}

Result<void> ComputeBackend::begin(const View& view) {
  assert(view.width >= 1 && view.width <= info_.max_view);
  assert(view.height >= 1 && view.height <= info_.max_view);
  VORPIPE_TRY(target_.resize(device_, painter_.pass(), static_cast<std::uint32_t>(view.width),
                             static_cast<std::uint32_t>(view.height)));
  VORPIPE_TRY(setView(view));
  return target_.clear(device_);
}

Result<void> ComputeBackend::read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) {
  assert(target_.framebuffer() != VK_NULL_HANDLE);
  return target_.read(device_, rgba, ids);
}

Result<void> ComputeBackend::compute(std::span<const Operands> operands, std::span<Computed> out) {
  return vulkan::compute(device_, storage_range_, operands, out);
}

// Puts the indices of sites on the device and binds them.
Result<void> ComputeBackend::sendWhich(std::span<const std::uint32_t> which) {
  assert(which.size() <= info_.max_entries);
  VORPIPE_TRY(entries_.reserve(device_, which.size_bytes(), info_.max_entries * sizeof(Entry)));
  std::memcpy(entries_.data(), which.data(), which.size_bytes());
  sites_bindings_.setStorage(device_, BINDING_ENTRIES, entries_.get(), which.size_bytes());
  return {};
}

// Puts a batch on the device and binds it.
Result<void> ComputeBackend::sendBatch(const CellBatch<float>& batch) {
  assert(batch.entries.size() <= info_.max_entries && batch.lines.size() <= info_.max_lines);
  const std::size_t bytes = batch.entries.size() * sizeof(Entry);
  VORPIPE_TRY(entries_.reserve(device_, bytes, info_.max_entries * sizeof(Entry)));
  VORPIPE_TRY(lines_.reserve(device_, batch.lines.size() * line_bytes, info_.max_lines * line_bytes));
  std::memcpy(entries_.data(), batch.entries.data(), bytes);
  std::ranges::copy(std::as_bytes(std::span(batch.lines)), lines_.data());
  lists_bindings_.setStorage(device_, BINDING_ENTRIES, entries_.get(), bytes);
  lists_bindings_.setTexels(device_, BINDING_LINES, lines_.texels());
  return {};
}

// Binds the buffers that polygons are written to, if anything has been drawn. A search binds them as well,
// which does not use them: lavapipe references every buffer of a set, and a replaced one no longer exists.
void ComputeBackend::bindPolygons(Bindings& bindings) const {
  if (vertices_.get() == VK_NULL_HANDLE) return;
  bindings.setStorage(device_, BINDING_VERTICES, vertices_.get(), VK_WHOLE_SIZE);
  bindings.setStorage(device_, BINDING_COUNTS, triangles_.counts(), VK_WHOLE_SIZE);
}

// How many entries a dispatch takes: at most `most`, and no more than a storage range has room for at
// `bytes_of_entry` of output each.
std::size_t ComputeBackend::sliceOf(std::size_t most, std::size_t bytes_of_entry) const {
  return std::min(
      {most, static_cast<std::size_t>(storage_range_ / bytes_of_entry), most_groups * GROUP_SIZE});
}

}  // namespace vorpipe::vulkan
