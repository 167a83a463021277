// The part of the backend "vulkan-compute" that draws.
#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "backend/cell_answers.h"
#include "backend/vulkan/compute.h"
#include "backend/vulkan/error.h"
#include "base/try.h"
#include "shaders.h"

namespace vorpipe::vulkan {
namespace {

// Entries whose polygons are on the device at one time: 16 MiB of vertices with room for 8 edges.
constexpr std::size_t slice_entries = std::size_t{1} << 17;

constexpr std::size_t word = sizeof(std::uint32_t);

}  // namespace

Result<void> ComputeBackend::draw(std::span<const std::uint32_t> which, Capacity capacity,
                                  std::span<CellStatus> status) {
  assert(status.size() == which.size() && !weighted_);
  if (which.empty()) return {};
  const bool small = capacity == Capacity::small;
  VORPIPE_TRY(sendWhich(which));
  return drawCells({sites_bindings_, small ? shaders::polygons_grid_fast() : shaders::polygons_grid_roomy(),
                    roomOf(capacity), which.size()},
                   status);
}

Result<void> ComputeBackend::draw(const CellBatch<float>& batch, std::span<const DrawMark> marks,
                                  Capacity capacity, std::span<CellStatus> status) {
  assert(marks.size() == batch.entries.size() && status.size() == batch.entries.size());
  if (status.empty()) return {};
  const bool small = capacity == Capacity::small;
  VORPIPE_TRY(sendBatch(batch));
  VORPIPE_TRY(marks_.reserve(device_, marks.size_bytes(), info_.max_entries * sizeof(DrawMark)));
  std::memcpy(marks_.data(), marks.data(), marks.size_bytes());
  lists_bindings_.setTexels(device_, BINDING_MARKS, marks_.texels());
  return drawCells({lists_bindings_, small ? shaders::polygons_list_fast() : shaders::polygons_list_roomy(),
                    roomOf(capacity), batch.entries.size()},
                   status);
}

Result<void> ComputeBackend::drawTriangles(std::span<const DrawMark> corners,
                                           std::span<const std::uint32_t> corner_of) {
  return painter_.draw(device_, target_, corners, corner_of, info_.max_lines);
}

// Clips the entries that were sent and draws them, slice by slice.
Result<void> ComputeBackend::drawCells(const ClipJob& job, std::span<CellStatus> status) {
  assert(target_.framebuffer() != VK_NULL_HANDLE);
  const std::size_t polygon_bytes = job.room * vertex_bytes;
  const std::size_t slice = std::min(job.count, sliceOf(slice_entries, polygon_bytes));
  VORPIPE_TRY(answers_.reserve(device_, slice * word, storage_range_));
  VORPIPE_TRY(vertices_.reserve(device_, slice * polygon_bytes, storage_range_));
  VORPIPE_TRY(triangles_.reserve(device_, slice, job.room));
  job.bindings.setStorage(device_, BINDING_STATUS, answers_.get(), slice * word);
  bindPolygons(job.bindings);
  VORPIPE_LET(kernel, kernels_.kernel(device_, job.bindings.layout(), job.code, sorted_here_));
  for (std::size_t first = 0; first < job.count; first += slice) {
    const std::size_t here = std::min(slice, job.count - first);
    VORPIPE_TRY(triangles_.prepare(device_, kernels_));
    VORPIPE_TRY(device_.run([&](VkCommandBuffer commands) {
      clearBefore(device_, commands, answers_.get(), here * word);
      dispatch(device_, commands, kernel, job.bindings,
               {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(here)}, here);
      orderShaders(device_, commands);
      triangles_.record(device_, commands, here);
      painter_.record(device_, commands, target_,
                      {vertices_.get(), triangles_.indices(), triangles_.arguments()});
    }));
    for (std::size_t entry = 0; entry < here; entry++) {
      std::uint32_t answer = 0;
      std::memcpy(&answer, answers_.data() + entry * word, word);
      status[first + entry] = statusIn(answer);
    }
  }
  return {};
}

}  // namespace vorpipe::vulkan
