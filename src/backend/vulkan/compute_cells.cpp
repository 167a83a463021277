// The part of the backend "vulkan-compute" that returns cells as data.
#include <algorithm>
#include <cassert>
#include <new>
#include <string>
#include <utility>

#include "backend/cell_answers.h"
#include "backend/to_float.h"
#include "backend/vulkan/compute.h"
#include "backend/vulkan/error.h"
#include "base/try.h"
#include "shaders.h"

namespace vorpipe::vulkan {
namespace {

// Entries whose neighbors are on the device at one time: few enough to stay in a cache on their way to
// the host, enough to keep a device busy.
constexpr std::size_t slice_entries = std::size_t{1} << 18;

constexpr std::size_t word_bytes = sizeof(std::uint32_t);

// Bytes of a word for each entry, rounded up to four words, as rows are.
constexpr std::size_t wordsBytes(std::size_t entries) { return (entries + 3) / 4 * 4 * word_bytes; }

ComputeKernels::Code searchCode(bool small, bool weighted) {
  if (weighted) {
    return small ? shaders::neighbors_grid_fast_weighted() : shaders::neighbors_grid_roomy_weighted();
  }
  return small ? shaders::neighbors_grid_fast() : shaders::neighbors_grid_roomy();
}

Result<void> clear(CellNeighbors& out) {
  out.status.clear();
  out.offsets.assign(1, 0);
  out.neighbor.clear();
  return {};
}

}  // namespace

Result<void> ComputeBackend::cells(std::span<const std::uint32_t> which, Capacity capacity,
                                   CellNeighbors& out) {
  assert(capacity == Capacity::small || capacity == Capacity::large);
  const bool small = capacity == Capacity::small;
  if (which.empty()) return clear(out);
  try {
    VORPIPE_TRY(sendWhich(which));
    return findCells(
        {sites_bindings_, searchCode(small, weighted_), roomOf(capacity), which.size(), weighted_}, out);
  } catch (const std::bad_alloc&) {
    return outOfMemory(which.size());
  }
}

Result<void> ComputeBackend::cells(const CellBatch<double>& batch, CellNeighbors& out) {
  if (batch.entries.empty()) return clear(out);
  try {
    VORPIPE_TRY(sendBatch(toFloat(batch)));
    return findCells(
        {lists_bindings_, shaders::neighbors_list_roomy(), roomOf(Capacity::large), batch.entries.size()},
        out);
  } catch (const std::bad_alloc&) {
    return outOfMemory(batch.entries.size());
  }
}

// Clips the entries that were sent, slice by slice.
Result<void> ComputeBackend::findCells(const ClipJob& job, CellNeighbors& out) {
  VORPIPE_TRY(clear(out));
  const std::size_t room = answerRoom(job.room, job.weighted);
  const std::size_t row_bytes = room * sizeof(std::int32_t);
  const std::size_t slice = std::min(job.count, sliceOf(slice_entries, row_bytes + 4 * word_bytes));
  const std::size_t answer_bytes = wordsBytes(slice) + slice * row_bytes;
  VORPIPE_TRY(answers_.reserve(device_, answer_bytes, storage_range_));
  job.bindings.setStorage(device_, BINDING_STATUS, answers_.get(), answer_bytes);
  bindPolygons(job.bindings);
  VORPIPE_LET(kernel, kernels_.kernel(device_, job.bindings.layout(), job.code, sorted_here_));
  reserve(job.count, room, out);
  for (std::size_t first = 0; first < job.count; first += slice) {
    const std::size_t here = std::min(slice, job.count - first);
    VORPIPE_TRY(device_.run([&](VkCommandBuffer commands) {
      clearBefore(device_, commands, answers_.get(), wordsBytes(here));
      dispatch(device_, commands, kernel, job.bindings,
               {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(here)}, here);
    }));
    append({here, room, answers_.data(), word_bytes, answers_.data() + wordsBytes(here), row_bytes}, out);
  }
  return {};
}

}  // namespace vorpipe::vulkan
