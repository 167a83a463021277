#include "cells/ties.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "cells/hidden_cells.h"
#include "cells/neighbor_rows.h"
#include "cells/tied_cells.h"
#include "cells/tied_vertices.h"
#include "cells/vertex_batch.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t placed_grain = 4096;
/// Relative to a cell's size: a longer tie may hide an error of the cell in double. The sites are then far
/// away, and their weight differences so large that cancellation spoils the corners.
constexpr double much_of_a_cell = 1e-4;
/// In ties; no chain of ties is this long.
constexpr double collapsed_ties = 1024;

class TieResolver {
 public:
  TieResolver(const ProposedCells& proposed, const Fineness& fineness, Disputes disputes,
              const Records& records, TiedCells& tied)
      : proposed_(proposed),
        sites_(proposed.sites),
        cells_(proposed.cells),
        fineness_(fineness),
        disputes_(disputes),
        records_(records),
        tied_(tied),
        sets_(tied.offsets.back()),
        disputed_(tied.cell.size()),
        unsure_(tied.cell.size()) {
    tied_.tie.resize(tied_.offsets.back());
    tied_.vertex.resize(tied_.offsets.back());
  }

  void run() {
    parallelFor(tied_.cell.size(), placed_grain, proposed_.threads,
                [&](std::size_t begin, std::size_t end) { joinSome(begin, end); });
    listDisputed();
    if (!tied_.disputed.empty()) return;
    makeVertices(proposed_, sets_, tied_);
    if (disputes_ == Disputes::are_listed) {
      forTiedCells(tied_, proposed_.threads, [&](std::size_t k) { findCollapsed(k); });
      listDisputed();
      if (!tied_.disputed.empty()) return;
    }
    auto wide = findWideVertices(proposed_, tied_, fineness_);
    tied_.wide = std::move(wide.quite);
    std::ranges::set_union(wide.nearly, marked(unsure_), std::back_inserter(tied_.unsure));
    dropCollapsed(proposed_, sets_, tied_);
  }

 private:
  /// An edge, computed from one of its two cells.
  struct ComputedEdge {
    AnchoredPoint begin, end;
    EdgeSpan span;
  };

  /// Joins corners of the tied cells begin to end - 1, which are placed in batches.
  void joinSome(std::size_t begin, std::size_t end) {
    CornerBatch batch(sites_);
    std::vector<AnchoredPoint> corners;
    const auto joinBatch = [&] {
      batch.place();
      for (std::size_t b = 0; b < batch.size(); ++b) {
        corners.clear();
        for (std::size_t e = 0; e < batch.row(b).size(); ++e) corners.push_back(batch.placeOf(b, e));
        join(batch.cell(b), batch.row(b), corners);
      }
      batch.clear();
    };
    const auto cellAt = [&](std::size_t k) { return tied_.cell[k]; };
    forCellsBySize(cells_, begin, end, cellAt, [&](std::uint32_t cell) {
      if (isRightlyEmpty(sites_, cells_, cell)) return;
      const auto row = cells_.edges(cell);
      if (!isWellFormed(sites_, cells_, cell)) return dispute(cell);
      if (batch.add(cell, row, joinBatch) != CornerBatch::Added::other) return;
      placeCorners(sites_, cell, row, corners);
      join(cell, row, corners);
    });
    joinBatch();
  }

  [[nodiscard]] AnchoredPoint cornerOf(std::size_t cell, std::span<const std::int32_t> row,
                                       std::size_t e) const {
    return cornerPosition(sites_, static_cast<std::int32_t>(cell), row[edgeBefore(row, e)], row[e]);
  }

  [[nodiscard]] ComputedEdge computeEdge(std::size_t cell, std::span<const std::int32_t> row, std::size_t e,
                                         const AnchoredPoint& begin, const AnchoredPoint& end) const {
    return {begin, end,
            edgeSpan(sites_, static_cast<std::int32_t>(cell), row[edgeBefore(row, e)], row[e],
                     row[edgeAfter(row, e)], begin, end, fineness_.shortestEdge(cell, row[e]))};
  }

  /// A value between half the diameter of the corners and the diameter.
  static double sizeOf(std::span<const AnchoredPoint> corners) {
    double size = 0;
    for (const AnchoredPoint& corner : corners)
      size = std::max(size, lengthOf(wayBetween(corners[0], corner)));
    return size;
  }

  void mark(std::int32_t cell, std::vector<std::uint8_t>& marks) {
    if (cell < 0) return;
    const auto k = tied_.entry[static_cast<std::size_t>(cell)];
    if (k != TiedCells::not_tied) std::atomic_ref(marks[k]).store(1, std::memory_order_relaxed);
  }
  void dispute(std::size_t cell) { mark(static_cast<std::int32_t>(cell), disputed_); }

  void markAround(std::size_t cell, std::span<const std::int32_t> row, std::size_t e,
                  std::vector<std::uint8_t>& marks) {
    mark(static_cast<std::int32_t>(cell), marks);
    for (const auto other : {edgeBefore(row, e), e, edgeAfter(row, e)}) mark(row[other], marks);
  }

  /// Whether two cells name different neighbors at an end of their edge, one of them a wall.
  [[nodiscard]] static bool differAboutWall(std::int32_t here, std::int32_t there) {
    return here != there && std::min(here, there) < 0;
  }

  void join(std::uint32_t cell, std::span<const std::int32_t> row, std::span<const AnchoredPoint> corners) {
    const auto k = tied_.entry[cell];
    const auto m = recordMeasures(sites_, cell, row.size(), corners, records_);
    const bool may_be_none =
        !sites_.weight.empty() && disputes_ == Disputes::are_listed && isFlat(m.area, m.perimeter);
    if (may_be_none && leaveNothing(sites_, cell, row)) return dispute(cell);
    const double much = much_of_a_cell * sizeOf(corners);
    for (std::size_t e = 0; e < row.size(); ++e) {
      if (isLong(cell, row[e], corners[e], corners[edgeAfter(row, e)]) && joinAlike(k, row, e)) continue;
      const auto here = computeEdge(cell, row, e, corners[e], corners[edgeAfter(row, e)]);
      if (here.span.isTie() && here.span.slack > much) markAround(cell, row, e, unsure_);
      if (here.span.is_coarse && here.span.isAboutATie()) markAround(cell, row, e, unsure_);
      // Near the point where two cells meet at a wall, rounding decides whether a third reaches the wall.
      if (row[e] < 0 && here.span.isTie()) markAround(cell, row, e, unsure_);
      if (here.span.isTurned() && disputes_ == Disputes::are_listed) markAround(cell, row, e, disputed_);
      if (row[e] < 0) {
        settle(k, row, e, here.span.isTie());
      } else {
        joinAcross(k, row, e, here);
      }
    }
  }

  /// Whether an edge lies between sites and is far from a tie.
  [[nodiscard]] bool isLong(std::size_t cell, std::int32_t neighbor, const AnchoredPoint& begin,
                            const AnchoredPoint& end) const {
    if (neighbor < 0) return false;
    const auto other = static_cast<std::size_t>(neighbor);
    const Point way = wayBetween(begin, end);
    return isFarFromATie(sites_.x[other] - sites_.x[cell], sites_.y[other] - sites_.y[cell], way.x, way.y);
  }

  /// Settles an edge as not a tie, if both cells have it with the same sites at its ends. Otherwise returns
  /// false.
  bool joinAlike(std::size_t k, std::span<const std::int32_t> row, std::size_t e) {
    const auto cell = tied_.cell[k];
    const auto other = static_cast<std::size_t>(row[e]);
    const auto other_row = cells_.edges(other);
    const auto back = proposed_.index.find(other_row, other, static_cast<std::int32_t>(cell));
    if (back == EdgeIndex::none) return false;
    const auto back_end = edgeAfter(other_row, back);
    if (other_row[back_end] != row[edgeBefore(row, e)] ||
        other_row[edgeBefore(other_row, back)] != row[edgeAfter(row, e)]) {
      return false;
    }
    settle(k, row, e, false);
    const auto other_k = tied_.entry[other];
    if (other_k == TiedCells::not_tied || other < cell) return true;
    sets_.join(cornerNumber(k, e), cornerNumber(other_k, back_end));
    sets_.join(cornerNumber(k, edgeAfter(row, e)), cornerNumber(other_k, back));
    return true;
  }

  /// Marks edges as disputed whose ends are joined although they are far longer than a tie: ties were wrong.
  void findCollapsed(std::size_t k) {
    const auto cell = tied_.cell[k];
    if (isRightlyEmpty(sites_, cells_, cell)) return;
    const auto row = cells_.edges(cell);
    for (std::size_t e = 0; e < row.size(); ++e) {
      const auto begin = tied_.offsets[k] + e, end = tied_.offsets[k] + edgeAfter(row, e);
      if (tied_.tie[begin] != 0 || tied_.vertex[begin] != tied_.vertex[end]) continue;
      const auto here =
          computeEdge(cell, row, e, cornerOf(cell, row, e), cornerOf(cell, row, edgeAfter(row, e)));
      const double length = lengthOf(wayBetween(here.begin, here.end));
      if (length > collapsed_ties * here.span.slack) markAround(cell, row, e, disputed_);
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> marked(const std::vector<std::uint8_t>& marks) const {
    std::vector<std::uint32_t> cells;
    for (std::size_t k = 0; k < marks.size(); ++k) {
      if (marks[k] != 0) cells.push_back(tied_.cell[k]);
    }
    return cells;
  }
  void listDisputed() { tied_.disputed = marked(disputed_); }

  [[nodiscard]] std::uint32_t cornerNumber(std::size_t k, std::size_t e) const {
    return static_cast<std::uint32_t>(tied_.offsets[k] + e);
  }

  /// Joins the ends of an edge in both cells; a cell that is not tied has no ties to pass on. If the cells
  /// name different sites at the ends, the lower one compares both computed edges.
  void joinAcross(std::size_t k, std::span<const std::int32_t> row, std::size_t e, const ComputedEdge& here) {
    const auto cell = tied_.cell[k];
    const auto other = static_cast<std::size_t>(row[e]);
    const auto other_row = cells_.edges(other);
    const auto back = proposed_.index.find(other_row, other, static_cast<std::int32_t>(cell));
    if (back == EdgeIndex::none) {
      if (!here.span.isTie()) disputeBoth(cell, row[e]);
      if (here.span.isAboutATie()) markAround(cell, row, e, unsure_);
      return settle(k, row, e, true);
    }
    const auto back_end = edgeAfter(other_row, back);
    const auto there_first = other_row[back_end], there_last = other_row[edgeBefore(other_row, back)];
    const auto first = row[edgeBefore(row, e)], last = row[edgeAfter(row, e)];
    const bool alike = there_first == first && there_last == last;
    if (alike) settle(k, row, e, here.span.isTie());
    const auto other_k = tied_.entry[other];
    if (differAboutWall(first, there_first) || differAboutWall(last, there_last)) {
      markAround(cell, row, e, unsure_);
      markAround(other, other_row, back, unsure_);
    }
    // A cell that is not tied has passed its check, and so has this edge.
    if (other_k == TiedCells::not_tied || other < cell) return;
    sets_.join(cornerNumber(k, e), cornerNumber(other_k, back_end));
    sets_.join(cornerNumber(k, edgeAfter(row, e)), cornerNumber(other_k, back));
    if (alike || !isWellFormed(sites_, cells_, other)) return;
    const ComputedEdge there = computeEdge(other, other_row, back, cornerOf(other, other_row, back),
                                           cornerOf(other, other_row, back_end));
    if (here.span.isAboutATie() || there.span.isAboutATie() || here.span.is_coarse || areApart(here, there)) {
      markAround(cell, row, e, unsure_);
      markAround(other, other_row, back, unsure_);
    }
    const bool tie = compare(cell, row[e], here, there);
    settle(k, row, e, tie);
    settle(other_k, other_row, back, tie);
  }

  /// Whether the ends of an edge, computed from its two cells, are so far apart that an edge longer than a
  /// tie may fit between them, which both cells lack.
  static bool areApart(const ComputedEdge& here, const ComputedEdge& there) {
    constexpr double share = 0.01;
    const double apart =
        std::max(lengthOf(wayBetween(here.begin, there.end)), lengthOf(wayBetween(here.end, there.begin)));
    return apart > share * here.span.slack;
  }

  void settle(std::size_t k, std::span<const std::int32_t> row, std::size_t e, bool tie) {
    const auto corner = cornerNumber(k, e);
    tied_.tie[corner] = tie ? 1 : 0;
    if (tie) sets_.join(corner, cornerNumber(k, edgeAfter(row, e)));
  }

  void disputeBoth(std::size_t cell, std::int32_t neighbor) {
    if (disputes_ == Disputes::are_ties) return;
    dispute(cell);
    mark(neighbor, disputed_);
  }

  /// Whether an edge, whose cells name different sites at its ends, is a tie. Disputes it if the cells
  /// disagree about that, or if it is not a tie and its ends differ by more than the slack.
  bool compare(std::size_t cell, std::int32_t neighbor, const ComputedEdge& here, const ComputedEdge& there) {
    if (here.span.isTie() != there.span.isTie()) disputeBoth(cell, neighbor);
    if (here.span.isTie() || there.span.isTie()) return true;
    const double slack = here.span.slack;
    const bool alike = lengthOf(wayBetween(here.begin, there.end)) <= slack &&
                       lengthOf(wayBetween(here.end, there.begin)) <= slack;
    if (!alike) disputeBoth(cell, neighbor);
    return false;
  }

  const ProposedCells& proposed_;
  const SiteSet& sites_;
  const NeighborRows& cells_;
  const Fineness& fineness_;
  Disputes disputes_;
  const Records& records_;
  TiedCells& tied_;
  DisjointSets sets_;
  std::vector<std::uint8_t> disputed_, unsure_;  ///< by tied cell
};

/// The first cell from `begin` on that is marked with 1; suspect.size() if there is none.
std::size_t nextMarked(std::span<const std::uint8_t> suspect, std::size_t begin) {
  const auto* found =
      begin < suspect.size() ? std::memchr(&suspect[begin], 1, suspect.size() - begin) : nullptr;
  return found == nullptr
             ? suspect.size()
             : static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - suspect.data());
}

}  // namespace

Result<TiedCells> resolveTies(const ProposedCells& proposed, std::span<const std::uint8_t> suspect,
                              const Fineness& fineness, Disputes disputes, const Records& records) {
  TiedCells tied;
  // In a lattice all cells are tied: lists that grew by doubling would take half as much memory again.
  const auto count = static_cast<std::size_t>(std::ranges::count(suspect, 1));
  tied.cell.reserve(count);
  tied.offsets.reserve(count + 1);
  tied.offsets.push_back(0);
  for (std::size_t cell = nextMarked(suspect, 0); cell < suspect.size();
       cell = nextMarked(suspect, cell + 1)) {
    if (tied.cell.empty()) {
      tied.entry.reserve(suspect.size());
      tied.entry.assign(suspect.size(), TiedCells::not_tied);
    }
    tied.entry[cell] = static_cast<std::uint32_t>(tied.cell.size());
    tied.cell.push_back(static_cast<std::uint32_t>(cell));
    tied.offsets.push_back(tied.offsets.back() + proposed.cells.edges(cell).size());
  }
  if (tied.offsets.back() >= std::numeric_limits<std::uint32_t>::max()) {
    return tl::unexpected(refusal(
        Subject::sites, fmt::format("{} tied corners are more than 4294967294", tied.offsets.back())));
  }
  if (!tied.cell.empty()) TieResolver(proposed, fineness, disputes, records, tied).run();
  return tied;
}

}  // namespace vorpipe::core
