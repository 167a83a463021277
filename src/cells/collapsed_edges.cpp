#include "cells/collapsed_edges.h"

#include <algorithm>

#include "base/parallel.h"
#include "cells/tied_vertices.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t collapsed_edges_grain = 1024;

/// Finds the cells that ties enclose: no path across edges leads from such a cell to a wall.
class EnclosedCells {
 public:
  EnclosedCells(const ProposedCells& proposed, DisjointSets& sets, TiedCells& tied)
      : sites_(proposed.sites), cells_(proposed.cells), sets_(sets), tied_(tied) {}

  /// Whether corners were joined.
  bool run() {
    countRings();
    for (std::size_t k = 0; k < tied_.cell.size(); ++k) {
      if (touchesRing(k)) searchFrom(tied_.cell[k]);
    }
    std::sort(tied_.enclosed.begin(), tied_.enclosed.end());
    return joined_;
  }

 private:
  enum class Known : std::uint8_t { nothing, enclosed, reaches_wall };

  static std::size_t after(std::span<const std::int32_t> row, std::size_t e) {
    return e + 1 < row.size() ? e + 1 : 0;
  }

  /// Joining n corners of the diagram without a cycle takes n - 1 ties: a tree. Counts ties - corners + 1 at
  /// each vertex, in sixths. Each of three cells contributes 2 for a corner of the diagram, each of two cells
  /// 3 at a wall, the only cell 6 in a corner of the domain. For a tie between two sites each of their cells
  /// contributes 3. If the count is 0 there is no cycle.
  void countRings() {
    excess_.assign(tied_.position.size(), one_corner);
    for (std::size_t k = 0; k < tied_.cell.size(); ++k) {
      const auto row = cells_.edges(tied_.cell[k]);
      for (std::size_t e = 0; e < row.size(); ++e) {
        const auto corner = tied_.offsets[k] + e;
        const int walls = (row[e] < 0 ? 1 : 0) + (row[e > 0 ? e - 1 : row.size() - 1] < 0 ? 1 : 0);
        excess_[tied_.vertex[corner]] -= walls == 0 ? 2 : (walls == 1 ? 3 : one_corner);
        if (tied_.tie[corner] != 0) excess_[tied_.vertex[corner]] += row[e] < 0 ? one_corner : 3;
      }
    }
  }

  [[nodiscard]] bool touchesRing(std::size_t k) const {
    for (auto c = tied_.offsets[k]; c < tied_.offsets[k + 1]; ++c) {
      if (excess_[tied_.vertex[c]] != 0) return true;
    }
    return false;
  }

  [[nodiscard]] bool isKept(std::uint32_t cell, std::size_t e) const {
    return !tied_.has(cell) || tied_.tie[tied_.offsets[tied_.entry[cell]] + e] == 0;
  }

  void searchFrom(std::uint32_t first) {
    if (known_.empty()) known_.assign(sites_.size(), Known::nothing);
    if (known_[first] != Known::nothing) return;
    region_.assign(1, first);
    known_[first] = Known::enclosed;
    auto what = Known::enclosed;
    for (std::size_t next = 0; next < region_.size(); ++next) {
      const auto cell = region_[next];
      const auto row = cells_.edges(cell);
      for (std::size_t e = 0; e < row.size(); ++e) {
        if (!isKept(cell, e)) continue;
        if (row[e] < 0) {
          what = Known::reaches_wall;
          continue;
        }
        auto& known = known_[static_cast<std::size_t>(row[e])];
        if (known == Known::reaches_wall) what = known;
        if (known != Known::nothing) continue;
        known = Known::enclosed;
        region_.push_back(static_cast<std::uint32_t>(row[e]));
      }
      if (what == Known::reaches_wall) break;
    }
    if (what == Known::enclosed) return collapse();
    for (const auto cell : region_) known_[cell] = what;
  }

  /// Makes one vertex of all corners of the cells in region_, one of which is tied.
  void collapse() {
    const auto vertex = static_cast<std::uint32_t>(tied_.offsets[tied_.entry[region_.front()]]);
    for (const auto cell : region_) {
      if (!tied_.has(cell)) {
        tied_.enclosed.push_back(cell);
        continue;
      }
      const auto k = tied_.entry[cell];
      for (auto c = tied_.offsets[k]; c < tied_.offsets[k + 1]; ++c) {
        joined_ = joined_ || sets_.root(static_cast<std::uint32_t>(c)) != sets_.root(vertex);
        sets_.join(static_cast<std::uint32_t>(c), vertex);
        tied_.tie[c] = 1;
      }
    }
  }

  static constexpr int one_corner = 6;

  const SiteSet& sites_;
  const NeighborRows& cells_;
  DisjointSets& sets_;
  TiedCells& tied_;
  std::vector<int> excess_;  ///< by vertex, in sixths: ties beyond a tree
  std::vector<Known> known_;
  std::vector<std::uint32_t> region_;
  bool joined_ = false;
};

}  // namespace

void dropCollapsed(const ProposedCells& proposed, DisjointSets& corners, TiedCells& tied) {
  parallelFor(tied.cell.size(), collapsed_edges_grain, proposed.threads,
              [&](std::size_t begin, std::size_t end) {
                for (auto k = begin; k < end; ++k) {
                  for (auto c = tied.offsets[k]; c < tied.offsets[k + 1]; ++c) {
                    const auto next = c + 1 < tied.offsets[k + 1] ? c + 1 : tied.offsets[k];
                    if (tied.vertex[c] == tied.vertex[next]) tied.tie[c] = 1;
                  }
                }
              });
  if (proposed.sites.weight.empty()) return;
  if (EnclosedCells(proposed, corners, tied).run() && tied.enclosed.empty()) {
    makeVertices(proposed, corners, tied);
  }
}

}  // namespace vorpipe::core
