#include "cells/neighbor_rows.h"

#include <algorithm>
#include <iterator>
#include <mutex>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t neighbor_rows_grain = std::size_t{1} << 15;

}  // namespace

NeighborRows::NeighborRows(std::size_t cells, int threads) : rows_(cells), threads_(threads) {
  parallelEach(cells, neighbor_rows_grain, threads, [&](std::size_t i) { drop(i, CellStatus::missing); });
}

void NeighborRows::add(std::span<const std::uint32_t> which, CellNeighbors found) {
  std::mutex mutex;
  parallelFor(which.size(), neighbor_rows_grain, threads_, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> large;
    for (auto e = begin; e < end; ++e) {
      const auto count = static_cast<std::uint32_t>(found.offsets[e + 1] - found.offsets[e]);
      const auto* const edges = found.neighbor.data() + found.offsets[e];
      rows_[which[e]] = {count > 0 ? edges : nothing.data(), count, found.status[e]};
      if (count > usual_edges) large.push_back(which[e]);
    }
    if (large.empty()) return;
    const std::lock_guard lock(mutex);
    large_.insert(large_.end(), large.begin(), large.end());
  });
  makeReadable(which, found);
  parts_.push_back(std::move(found.neighbor));
}

/// Copies the rows at the end of a part to memory where enough numbers follow.
void NeighborRows::makeReadable(std::span<const std::uint32_t> which, const CellNeighbors& found) {
  const auto& numbers = found.neighbor;
  auto e = which.size();
  while (e > 0 && found.offsets[e - 1] + readable > numbers.size()) --e;
  if (e == which.size()) return;
  const auto begin = found.offsets[e];
  BigVector<std::int32_t> last(numbers.begin() + static_cast<std::ptrdiff_t>(begin), numbers.end());
  last.resize(last.size() + readable);
  for (; e < which.size(); ++e) {
    auto& row = rows_[which[e]];
    if (row.count > 0) row.edges = last.data() + (found.offsets[e] - begin);
  }
  parts_.push_back(std::move(last));
}

void NeighborRows::add(std::span<const std::uint32_t> which, NeighborRows found) {
  parallelEach(which.size(), neighbor_rows_grain, threads_,
               [&](std::size_t e) { rows_[which[e]] = found.rows_[e]; });
  std::move(found.parts_.begin(), found.parts_.end(), std::back_inserter(parts_));
  for (const auto e : found.large_) large_.push_back(which[e]);
}

std::vector<std::uint32_t> NeighborRows::large() const {
  auto cells = large_;
  std::erase_if(cells, [&](std::uint32_t cell) { return rows_[cell].count <= usual_edges; });
  sortWithoutRepeats(cells);
  return cells;
}

EdgeIndex::EdgeIndex(const NeighborRows& cells, int threads) {
  for (const auto cell : cells.large()) large_.push_back({cell, {}});
  parallelEach(large_.size(), 1, threads, [&](std::size_t k) {
    const auto row = cells.edges(large_[k].cell);
    auto& edges = large_[k].edges;
    edges.resize(row.size());
    for (std::size_t e = 0; e < row.size(); ++e) edges[e] = {row[e], static_cast<std::uint32_t>(e)};
    std::sort(edges.begin(), edges.end());
  });
}

std::size_t EdgeIndex::findInLarge(std::size_t cell, std::int32_t neighbor) const {
  const auto large = std::lower_bound(large_.begin(), large_.end(), cell,
                                      [](const Large& l, std::size_t wanted) { return l.cell < wanted; });
  const auto found =
      std::lower_bound(large->edges.begin(), large->edges.end(), std::pair{neighbor, std::uint32_t{0}});
  return found != large->edges.end() && found->first == neighbor ? found->second : none;
}

}  // namespace vorpipe::core
