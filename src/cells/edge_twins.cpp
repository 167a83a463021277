#include "cells/edge_twins.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t edge_twins_grain = 4096;

using Shift = std::array<std::int32_t, 2>;

class TwinFinder {
 public:
  TwinFinder(const Diagram& diagram, std::span<const std::uint32_t> vertex_of,
             std::vector<std::uint32_t>& twins)
      : diagram_(diagram), vertex_of_(vertex_of), twins_(twins) {}

  /// Of a pair, the cell with more edges searches the other's list: its neighbors do not each search a cell
  /// with 100,000 neighbors. So each entry is written for one pair only.
  void find(const Cell& cell) {
    for (auto entry = cell.begin(); entry < cell.end(); ++entry) {
      const std::int64_t neighbor = diagram_.neighbors[entry];
      if (isWall(neighbor) || static_cast<std::uint64_t>(neighbor) >= diagram_.size()) continue;
      const Cell other = diagram_.cell(static_cast<std::size_t>(neighbor));
      if (std::pair(other.edges(), other.index()) > std::pair(cell.edges(), cell.index())) continue;
      if (twins_[entry] != no_twin) continue;  // between two images of the same cell
      for (auto back = other.begin(); back < other.end(); ++back) {
        if (back == entry || !areOne(cell, entry, other, back) || twins_[back] != no_twin) continue;
        twins_[entry] = static_cast<std::uint32_t>(back);
        twins_[back] = static_cast<std::uint32_t>(entry);
        break;
      }
    }
  }

 private:
  [[nodiscard]] bool areOne(const Cell& cell, std::uint64_t entry, const Cell& other,
                            std::uint64_t back) const {
    if (diagram_.neighbors[back] != static_cast<std::int64_t>(cell.index())) return false;
    if (!diagram_.neighbor_shifts.empty()) {
      const Shift there = diagram_.neighbor_shifts[entry], here = diagram_.neighbor_shifts[back];
      return there == Shift{-here[0], -here[1]};
    }
    if (diagram_.ring_starts.empty()) return true;
    return vertex_of_[entry] == vertex_of_[nextEntry(diagram_, other, back)] &&
           vertex_of_[back] == vertex_of_[nextEntry(diagram_, cell, entry)];
  }

  const Diagram& diagram_;
  std::span<const std::uint32_t> vertex_of_;
  std::vector<std::uint32_t>& twins_;
};

}  // namespace

std::uint64_t nextEntry(const Diagram& diagram, const Cell& cell, std::uint64_t entry) {
  std::uint64_t begin = cell.begin(), end = cell.end();
  const auto& starts = diagram.ring_starts;
  if (!starts.empty()) {
    const auto after = std::ranges::upper_bound(starts, entry);
    if (after != starts.begin()) begin = std::max(begin, *(after - 1));
    if (after != starts.end()) end = std::min(end, *after);
  }
  return entry + 1 < end ? entry + 1 : begin;
}

Result<std::vector<std::uint32_t>> findTwins(const Diagram& diagram, std::span<const std::uint32_t> vertex_of,
                                             int threads) {
  std::vector<std::uint32_t> twins(diagram.neighbors.size(), no_twin);
  parallelFor(diagram.size(), edge_twins_grain, threads, [&](std::size_t begin, std::size_t end) {
    TwinFinder finder(diagram, vertex_of, twins);
    for (auto i = begin; i < end; ++i) finder.find(diagram.cell(i));
  });
  for (const Cell cell : diagram) {
    for (auto entry = cell.begin(); entry < cell.end(); ++entry) {
      const std::int64_t neighbor = diagram.neighbors[entry];
      if (isWall(neighbor) || twins[entry] != no_twin) continue;
      return tl::unexpected(Error{
          ErrorCode::input,
          fmt::format("sites {} and {} do not have the same edges with each other", cell.index(), neighbor)});
    }
  }
  return twins;
}

}  // namespace vorpipe::core
