#include "cells/answers.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "base/parallel.h"
#include "base/try.h"
#include "cells/neighbor_rows.h"
#include "geometry/vertex_predicates.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t answers_grain = std::size_t{1} << 15;
constexpr std::size_t pixels_at_once = std::size_t{1} << 16;

constexpr std::size_t least_edges = 3;

/// For entries of a batch, whose lines do not include their own site: a number that no neighbor has.
constexpr std::int64_t no_own_site = std::numeric_limits<std::int64_t>::min();

Error nonsense(const Backend& backend, std::string_view what) {
  const auto& device = backend.info().device;
  return {ErrorCode::device, fmt::format("{} on {}: its answer makes no sense, {}: update the driver, or use "
                                         "another --device or --backend cpu",
                                         device.backend, device.name, what)};
}

/// Why the arrays of an answer about `count` cells contradict each other; empty if they do not.
std::string_view whatIsWrong(const CellNeighbors& cells, std::size_t count) {
  if (cells.status.size() != count) return "it is of another number of cells";
  if (cells.offsets.size() != count + 1 || cells.offsets.front() != 0 ||
      cells.offsets.back() != cells.neighbor.size() ||
      !std::is_sorted(cells.offsets.begin(), cells.offsets.end())) {
    return "the places of its neighbors are no places";
  }
  return {};
}

/// Whether a cell with this status can have these neighbors. Each must be a wall or less than `count`, the
/// number of sites or lines, and not the cell's own site. A certified cell's neighbors begin with the
/// smallest number.
bool couldBe(CellStatus status, std::span<const std::int32_t> neighbors, std::int64_t self,
             std::int64_t count) {
  if (!isDone(status)) return neighbors.empty();
  const bool in_range = std::all_of(neighbors.begin(), neighbors.end(), [&](std::int32_t neighbor) {
    return neighbor >= wall_ymax && neighbor < count && neighbor != self;
  });
  if (!in_range || status == CellStatus::empty) return in_range;
  return neighbors.size() >= least_edges &&
         *std::min_element(neighbors.begin(), neighbors.end()) == neighbors.front();
}

/// Removes the neighbors of all entries that are not done; the others keep theirs in order.
void dropOthers(CellNeighbors& cells) {
  std::uint64_t end = 0;
  std::uint64_t begin = cells.offsets[0];
  for (std::size_t e = 0; e < cells.status.size(); ++e) {
    const auto next = cells.offsets[e + 1];
    if (isDone(cells.status[e])) {
      for (auto k = begin; k < next; ++k) cells.neighbor[end++] = cells.neighbor[k];
    }
    cells.offsets[e + 1] = end;
    begin = next;
  }
  cells.neighbor.resize(end);
}

/// Makes entries `missing` that cannot be cells. limitsOf(e) returns the number of entry e's own site, and
/// the number of sites or lines that its neighbors can be. Error (device): see whatIsWrong.
template <class LimitsOf>
Result<void> secure(const Backend& backend, std::size_t count, int threads, CellNeighbors& cells,
                    const LimitsOf& limitsOf) {
  if (const auto wrong = whatIsWrong(cells, count); !wrong.empty()) {
    return tl::unexpected(nonsense(backend, wrong));
  }
  std::atomic<bool> any = false;
  parallelEach(count, answers_grain, threads, [&](std::size_t e) {
    const auto [self, most] = limitsOf(e);
    const auto neighbors =
        std::span(cells.neighbor).subspan(cells.offsets[e], cells.offsets[e + 1] - cells.offsets[e]);
    const bool known = cells.status[e] <= CellStatus::open;
    if (known && couldBe(cells.status[e], neighbors, self, most)) return;
    cells.status[e] = CellStatus::missing;
    any.store(true, std::memory_order_relaxed);
  });
  if (any) dropOthers(cells);
  return {};
}

void secure(std::span<CellStatus> status) {
  for (auto& each : status) {
    if (each > CellStatus::open) each = CellStatus::missing;
  }
}

struct Limits {
  std::int64_t self, count;
};

}  // namespace

Result<void> askCells(Backend& backend, std::size_t sites, std::span<const std::uint32_t> which,
                      Capacity capacity, int threads, CellNeighbors& out) {
  VORPIPE_TRY(backend.cells(which, capacity, out));
  const auto count = static_cast<std::int64_t>(sites);
  return secure(backend, which.size(), threads, out, [&](std::size_t e) { return Limits{which[e], count}; });
}

Result<void> askCells(Backend& backend, const CellBatch<double>& batch, int threads, CellNeighbors& out) {
  VORPIPE_TRY(backend.cells(batch, out));
  return secure(backend, batch.entries.size(), threads, out, [&](std::size_t e) {
    return Limits{no_own_site, batch.entries[e].count};
  });
}

Result<void> askToDraw(Backend& backend, std::span<const std::uint32_t> which, Capacity capacity,
                       std::span<CellStatus> status) {
  VORPIPE_TRY(backend.draw(which, capacity, status));
  secure(status);
  return {};
}

Result<void> askToDraw(Backend& backend, const CellBatch<float>& batch, std::span<const DrawMark> marks,
                       Capacity capacity, std::span<CellStatus> status) {
  VORPIPE_TRY(backend.draw(batch, marks, capacity, status));
  secure(status);
  return {};
}

PixelCheck::PixelCheck(const SiteSet& sites, std::span<const std::uint8_t> palette_index, int threads)
    : sites_(sites), palette_index_(palette_index), threads_(threads) {}

void PixelCheck::apply(std::span<const CellStatus> status, const Palette& palette,
                       std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) {
  if (shown_.empty()) {
    const auto greatest = std::max_element(sites_.id.begin(), sites_.id.end());
    shown_.resize(greatest == sites_.id.end() ? 0 : std::size_t{*greatest} + 1);
  }
  parallelEach(sites_.size(), answers_grain, threads_, [&](std::size_t i) {
    const bool has_cell = status[i] == CellStatus::certified;
    shown_[sites_.id[i]] = has_cell ? static_cast<std::uint16_t>(palette_index_[i] + 1) : std::uint16_t{0};
  });
  parallelEach(ids.size(), pixels_at_once, threads_, [&](std::size_t i) {
    const auto shown = ids[i] < shown_.size() ? shown_[ids[i]] : std::uint16_t{0};
    rgba[i] = shown > 0 ? palette[shown - std::size_t{1}] : 0;
    if (shown == 0) ids[i] = no_site;
  });
}

}  // namespace vorpipe::core
