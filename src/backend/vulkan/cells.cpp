// The part of the backend "vulkan-geometry" that returns cells as data.
#include <algorithm>
#include <array>
#include <cassert>
#include <new>
#include <string>
#include <utility>

#include "backend/cell_answers.h"
#include "backend/to_float.h"
#include "backend/vulkan/error.h"
#include "backend/vulkan/geometry.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"

namespace vorpipe::vulkan {
namespace {

// Entries whose neighbors are on the device at one time: some 3 MiB of them.
constexpr std::size_t slice_entries = 65536;

}  // namespace

Result<void> GeometryBackend::cells(const CellBatch<double>& batch, CellNeighbors& out) {
  try {
    const DrawMark any{};
    VORPIPE_TRY(sendBatch(toFloat(batch), std::span(&any, 1)));
    return findCells({Capacity::large, Entries::lists, entries_.get(), sizeof(CellBatch<float>::Entry),
                      batch.entries.size()},
                     out);
  } catch (const std::bad_alloc&) {
    return outOfMemory(batch.entries.size());
  }
}

Result<void> GeometryBackend::cells(std::span<const std::uint32_t> which, Capacity capacity,
                                    CellNeighbors& out) {
  assert(capacity == Capacity::small || capacity == Capacity::large);
  try {
    VORPIPE_TRY(sendWhich(which));
    return findCells({capacity, siteEntries(), which_.get(), sizeof(which[0]), which.size()}, out);
  } catch (const std::bad_alloc&) {
    return outOfMemory(which.size());
  }
}

// Clips the entries in a vertex buffer, slice by slice.
Result<void> GeometryBackend::findCells(const CellWork& work, CellNeighbors& out) {
  out = {};
  out.offsets.push_back(0);
  if (work.count == 0) return {};
  VORPIPE_TRY(createEmptyFramebuffer());
  const bool small = work.capacity == Capacity::small && work.entries != Entries::lists;
  const bool weighted = work.entries == Entries::weighted_sites;
  const std::size_t room = answerRoom(small ? EDGES_FAST : EDGES_MOST, weighted);
  const std::size_t row_bytes = room * sizeof(std::int32_t);
  const std::size_t range =
      std::min<std::size_t>(info_.max_entries * sizeof(std::uint32_t), device_.largestAllocation());
  const std::size_t slice = std::min({work.count, slice_entries, range / row_bytes});
  VORPIPE_TRY(reserveStatus(slice));
  VORPIPE_TRY(edges_.reserve(device_, slice * row_bytes,
                             slice_entries * answerRoom(EDGES_MOST, true) * sizeof(std::int32_t)));
  bindings_.setStorage(device_, BINDING_EDGES, edges_.get(), slice * row_bytes);
  VORPIPE_LET(pipeline, pipelines_.edges(device_, bindings_.layout(), work.entries, work.capacity));
  const VkBuffer second = work.entries == Entries::lists ? marks_.get() : work.vertices;
  const Pass pass{pipeline, pipelines_.emptyPass(),  empty_framebuffer_.get(),
                  {1, 1},   {work.vertices, second}, work.stride};
  for (std::size_t first = 0; first < work.count; first += slice) {
    const std::size_t here = std::min(slice, work.count - first);
    VORPIPE_TRY(run(pass, first, here));
    append({here, room, host_status_.data(), sizeof(std::uint32_t), edges_.data(), row_bytes}, out);
  }
  return {};
}

Result<void> GeometryBackend::createEmptyFramebuffer() {
  if (empty_framebuffer_) return {};
  auto info = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
  info.renderPass = pipelines_.emptyPass();
  info.width = 1;
  info.height = 1;
  info.layers = 1;
  VORPIPE_VAR(framebuffer, create(device_.handle(), device_.api().vkCreateFramebuffer,
                                  device_.api().vkDestroyFramebuffer, info, "vkCreateFramebuffer"));
  empty_framebuffer_ = std::move(framebuffer);
  return {};
}

}  // namespace vorpipe::vulkan
