// The part of the backend "vulkan-geometry" that draws.
#include <algorithm>
#include <cassert>
#include <cstring>
#include <span>
#include <utility>

#include "backend/cell_answers.h"
#include "backend/vulkan/error.h"
#include "backend/vulkan/geometry.h"
#include "base/try.h"

namespace vorpipe::vulkan {
namespace {

using Entry = CellBatch<float>::Entry;
constexpr std::size_t line_bytes = sizeof(HalfPlane<float>);
static_assert(line_bytes == 4 * sizeof(float));

}  // namespace

// Puts a batch on the device and binds it.
Result<void> GeometryBackend::sendBatch(const CellBatch<float>& batch, std::span<const DrawMark> marks) {
  const std::size_t max_entries = info_.max_entries;
  assert(batch.entries.size() <= max_entries && batch.lines.size() <= info_.max_lines);
  VORPIPE_TRY(entries_.reserve(device_, batch.entries.size() * sizeof(Entry), max_entries * sizeof(Entry)));
  VORPIPE_TRY(marks_.reserve(device_, marks.size_bytes(), max_entries * sizeof(DrawMark)));
  VORPIPE_TRY(lines_.reserve(device_, batch.lines.size() * line_bytes, info_.max_lines * line_bytes));
  std::memcpy(entries_.data(), batch.entries.data(), batch.entries.size() * sizeof(Entry));
  std::memcpy(marks_.data(), marks.data(), marks.size_bytes());
  std::ranges::copy(std::as_bytes(std::span(batch.lines)), lines_.data());
  bindings_.setTexels(device_, BINDING_LINES, lines_.texels());
  return {};
}

Result<void> GeometryBackend::sendWhich(std::span<const std::uint32_t> which) {
  assert(which.size() <= info_.max_entries);
  VORPIPE_TRY(which_.reserve(device_, which.size_bytes(), info_.max_entries * sizeof(which[0])));
  std::memcpy(which_.data(), which.data(), which.size_bytes());
  return {};
}

Result<void> GeometryBackend::draw(const CellBatch<float>& batch, std::span<const DrawMark> marks,
                                   Capacity capacity, std::span<CellStatus> status) {
  assert(marks.size() == batch.entries.size() && status.size() == batch.entries.size());
  if (status.empty()) return {};
  VORPIPE_TRY(sendBatch(batch, marks));
  return drawEntries(Entries::lists, capacity, {entries_.get(), marks_.get()}, status);
}

Result<void> GeometryBackend::draw(std::span<const std::uint32_t> which, Capacity capacity,
                                   std::span<CellStatus> status) {
  assert(status.size() == which.size());
  if (which.empty()) return {};
  VORPIPE_TRY(sendWhich(which));
  return drawEntries(siteEntries(), capacity, {which_.get(), which_.get()}, status);
}

Result<void> GeometryBackend::drawTriangles(std::span<const DrawMark> corners,
                                            std::span<const std::uint32_t> corner_of) {
  if (!painter_) {
    VORPIPE_VAR(painter, Painter::create(device_));
    painter_.emplace(std::move(painter));
  }
  VORPIPE_TRY(painter_->setPalette(device_, shown_.palette));
  return painter_->draw(device_, target_, corners, corner_of, info_.max_lines);
}

Result<void> GeometryBackend::drawEntries(Entries entries, Capacity capacity,
                                          std::array<VkBuffer, 2> vertices, std::span<CellStatus> status) {
  assert(target_.framebuffer() != VK_NULL_HANDLE);
  VORPIPE_TRY(reserveStatus(status.size()));
  VORPIPE_LET(pipeline, pipelines_.draw(device_, bindings_.layout(), entries, capacity));
  VORPIPE_TRY(run({pipeline, pipelines_.targetPass(), target_.framebuffer(), target_.extent(), vertices, 0},
                  0, status.size()));
  for (std::size_t entry = 0; entry < status.size(); entry++) {
    std::uint32_t word = 0;
    std::memcpy(&word, host_status_.data() + entry * sizeof(word), sizeof(word));
    status[entry] = statusIn(word);
  }
  return {};
}

}  // namespace vorpipe::vulkan
