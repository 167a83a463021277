#include "cells/cell_check.h"

#include <array>
#include <atomic>

#include "base/inside.h"
#include "base/parallel.h"
#include "cells/neighbor_rows.h"
#include "cells/vertex_batch.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t most_checked_at_once = 4096;

class CellCheck {
 public:
  CellCheck(const ProposedCells& proposed, const Records& records, std::span<std::uint8_t> suspect)
      : proposed_(proposed),
        sites_(proposed.sites),
        cells_(proposed.cells),
        records_(records),
        suspect_(suspect),
        batch_(proposed.sites) {}

  void check(std::uint32_t cell) {
    const auto row = cells_.edges(cell);
    const bool certified = cells_.status(cell) == CellStatus::certified;
    const auto added = certified ? batch_.add(cell, row, [&] { finish(); }) : CornerBatch::Added::other;
    if (added == CornerBatch::Added::other) {
      checkAlone(cell, row);
    } else {
      records_.prefetch(cell);
    }
  }

  void finish() {
    batch_.place();
    bool any = false;
    std::array<bool, CornerBatch::most_cells> passed{};
    for (std::size_t k = 0; k < batch_.size(); ++k) {
      passed[k] =
          passes(batch_.cell(k), batch_.row(k), [&](std::size_t e) { return batch_.excess(k, e) > 0; });
      any = any || passed[k];
    }
    if (any) measure();
    for (std::size_t k = 0; k < batch_.size(); ++k) {
      if (passed[k]) record(k);
    }
    batch_.clear();
  }

 private:
  void measure() {
    if (records_.spread.empty()) {
      batch_.measure();
    } else {
      batch_.measureSpread();
    }
  }

  /// The spread about the centroid; `centroid` is relative to the measuring origin.
  [[nodiscard]] double spreadInBatch(std::size_t k, double area, Point centroid) const {
    if (records_.spread.empty()) return 0;
    return batch_.spread(k) / 12 - area * (centroid.x * centroid.x + centroid.y * centroid.y);
  }

  void mark(std::int32_t neighbor) {
    if (neighbor < 0 || static_cast<std::size_t>(neighbor) >= sites_.size()) return;
    std::atomic_ref(suspect_[static_cast<std::size_t>(neighbor)]).store(1, std::memory_order_relaxed);
  }

  /// Whether an edge of `cell` begins at the same three sites in the cell on its other side. If this holds
  /// for all edges of all cells, they end alike too, and neighbors are mutual.
  bool beginsAlike(std::uint32_t cell, std::int32_t before, std::int32_t neighbor) const {
    if (neighbor < 0) return true;
    const auto other = static_cast<std::size_t>(neighbor);
    const auto row = cells_.edges(other);
    const auto back = proposed_.index.find(row, other, static_cast<std::int32_t>(cell));
    return back != EdgeIndex::none && row[edgeAfter(row, back)] == before;
  }

  /// Checks every edge; isLong(e): whether edge e is longer than a tie. A tie marks the cells at its ends
  /// as well.
  template <class IsLong>
  bool passes(std::uint32_t cell, std::span<const std::int32_t> row, const IsLong& is_long) {
    bool all = true;
    auto before = row.back();
    for (std::size_t e = 0; e < row.size(); ++e) {
      const auto neighbor = row[e];
      const bool tie = !is_long(e);
      if (tie || !beginsAlike(cell, before, neighbor)) {
        all = false;
        mark(neighbor);
        if (tie) {
          mark(before);
          mark(row[edgeAfter(row, e)]);
        }
      }
      before = neighbor;
    }
    if (!all) mark(static_cast<std::int32_t>(cell));
    return all;
  }

  [[nodiscard]] double perimeterOf(std::size_t k) const {
    const auto edges = batch_.row(k).size();
    double perimeter = 0;
    for (std::size_t e = 0; e < edges; ++e) {
      perimeter += lengthOf(wayBetween(batch_.placeOf(k, e), batch_.placeOf(k, e + 1 < edges ? e + 1 : 0)));
    }
    return perimeter;
  }

  void record(std::size_t k) {
    const auto cell = batch_.cell(k);
    const double area = batch_.twiceArea(k) / 2;
    const auto moment = batch_.moment(k);
    if (!sites_.weight.empty() && isFlat(area, perimeterOf(k))) mark(static_cast<std::int32_t>(cell));
    const double third = 1 / (3 * batch_.twiceArea(k));
    const auto origin = measuringOrigin(sites_, cell, batch_.placeOf(k, 0));
    const Point centroid{moment.x * third, moment.y * third};
    records_.cell(cell, batch_.row(k).size(), area, origin, centroid, spreadInBatch(k, area, centroid));
  }

  void checkAlone(std::uint32_t cell, std::span<const std::int32_t> row) {
    if (isRightlyEmpty(sites_, cells_, cell)) return records_.empty(cell);
    if (!isWellFormed(sites_, cells_, cell)) return mark(static_cast<std::int32_t>(cell));
    const auto self = static_cast<std::int32_t>(cell);
    placeCorners(sites_, cell, row, corners_);
    const bool passed = passes(cell, row, [&](std::size_t e) {
      const auto after = edgeAfter(row, e);
      return !edgeSpan(sites_, self, row[edgeBefore(row, e)], row[e], row[after], corners_[e],
                       corners_[after])
                  .isTie();
    });
    if (!passed) return;
    const auto origin = measuringOrigin(sites_, cell, corners_.front());
    const auto m = measureCell(origin, corners_);
    if (!sites_.weight.empty() && isFlat(m.area, m.perimeter)) mark(static_cast<std::int32_t>(cell));
    records_.cell(cell, row.size(), m.area, origin, m.centroid, spreadOf(m));
  }

  const ProposedCells& proposed_;
  const SiteSet& sites_;
  const NeighborRows& cells_;
  const Records& records_;
  std::span<std::uint8_t> suspect_;
  CornerBatch batch_;
  std::vector<AnchoredPoint> corners_;
};

/// Prefetches cells about one row of bins ahead. Cells are checked row by row, so these are read next and are
/// not in the cache yet. (If it were not inlined, GCC would treat it as a function without effects and drop
/// the call.)
[[gnu::always_inline]] inline void prefetchBeyond(const ProposedCells& proposed, std::size_t cell) {
#if defined(__GNUC__)
  const auto& sites = proposed.sites;
  const auto beyond = cell + 2 * sites.size() / sites.grid.rows;
  if (beyond >= sites.size()) return;
  __builtin_prefetch(proposed.cells.edges(beyond).data());
  __builtin_prefetch(&sites.x[beyond]);
  __builtin_prefetch(&sites.y[beyond]);
#else
  (void)proposed, (void)cell;
#endif
}

template <class CellAt>
void checkSome(const ProposedCells& proposed, std::size_t count, const CellAt& cellAt, const Records& records,
               std::span<std::uint8_t> suspect) {
  parallelFor(count, grainFor(count, most_checked_at_once), proposed.threads,
              [&](std::size_t begin, std::size_t end) {
                for (auto k = begin; k < end; ++k) prefetchBeyond(proposed, cellAt(k));
                CellCheck cell_check(proposed, records, suspect);
                forCellsBySize(proposed.cells, begin, end, cellAt,
                               [&](std::uint32_t cell) { cell_check.check(cell); });
                cell_check.finish();
              });
}

}  // namespace

bool isWellFormed(const SiteSet& sites, const NeighborRows& cells, std::size_t cell) {
  const auto row = cells.edges(cell);
  if (cells.status(cell) != CellStatus::certified || row.size() < 3) return false;
  for (const auto neighbor : row) {
    if (neighbor < wall_ymax) return false;
    if (neighbor >= 0 &&
        (static_cast<std::size_t>(neighbor) >= sites.size() || static_cast<std::size_t>(neighbor) == cell)) {
      return false;
    }
  }
  return true;
}

bool isRightlyEmpty(const SiteSet& sites, const NeighborRows& cells, std::size_t cell) {
  const bool may_be = !sites.weight.empty() || !isInside(sites.domain, sites.x[cell], sites.y[cell]);
  return cells.status(cell) == CellStatus::empty && cells.edges(cell).empty() && may_be;
}

void checkCells(const ProposedCells& proposed, std::span<const std::uint32_t> which, const Records& records,
                std::span<std::uint8_t> suspect) {
  checkSome(
      proposed, which.size(), [&](std::size_t k) { return which[k]; }, records, suspect);
}

void checkCells(const ProposedCells& proposed, const Records& records, std::span<std::uint8_t> suspect) {
  const auto all = [](std::size_t cell) { return static_cast<std::uint32_t>(cell); };
  checkSome(proposed, proposed.sites.size(), all, records, suspect);
}

}  // namespace vorpipe::core
