/// Visits cells with their corners.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells/neighbor_rows.h"
#include "cells/vertex_batch.h"

namespace vorpipe::core {

/// For one thread; sites and cells outlive it.
class CellWalk {
 public:
  CellWalk(const SiteSet& sites, const NeighborRows& cells) : sites_(sites), cells_(cells), batch_(sites) {}

  /// Calls take(cell, row, corners) for each non-empty cell from `begin` to `end` - 1, in any order. `row`
  /// holds its neighbors, and `corners` the points where the edges to them begin, ties included.
  template <class Take>
  void operator()(std::size_t begin, std::size_t end, const Take& take) {
    walk(
        begin, end, [](std::size_t cell) { return static_cast<std::uint32_t>(cell); }, take);
  }

  /// The same for each of these cells.
  template <class Take>
  void operator()(std::span<const std::uint32_t> which, const Take& take) {
    walk(
        0, which.size(), [&](std::size_t k) { return which[k]; }, take);
  }

 private:
  template <class CellAt, class Take>
  void walk(std::size_t begin, std::size_t end, const CellAt& cellAt, const Take& take) {
    forCellsBySize(cells_, begin, end, cellAt, [&](std::uint32_t cell) { visit(cell, take); });
    takeBatch(take);
  }

  template <class Take>
  void visit(std::uint32_t cell, const Take& take) {
    if (cells_.status(cell) == CellStatus::empty) return;
    const auto row = cells_.edges(cell);
    if (batch_.add(cell, row, [&] { takeBatch(take); }) != CornerBatch::Added::other) return;
    placeCorners(sites_, cell, row, corners_);
    take(cell, row, std::span<const AnchoredPoint>(corners_));
  }

  template <class Take>
  void takeBatch(const Take& take) {
    batch_.place();
    for (std::size_t k = 0; k < batch_.size(); ++k) {
      const auto row = batch_.row(k);
      corners_.clear();
      for (std::size_t e = 0; e < row.size(); ++e) corners_.push_back(batch_.placeOf(k, e));
      take(batch_.cell(k), row, std::span<const AnchoredPoint>(corners_));
    }
    batch_.clear();
  }

  const SiteSet& sites_;
  const NeighborRows& cells_;
  CornerBatch batch_;
  std::vector<AnchoredPoint> corners_;
};

}  // namespace vorpipe::core
