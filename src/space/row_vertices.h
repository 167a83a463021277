/// The vertices of one cell, numbered by its row alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "space/rows.h"

namespace vorpipe::space {

/// Numbers the vertices of rows, one row after another. An edge end is a place in the rings of a row, all put
/// behind one another: number e of face f's ring r, at k, stands for the vertex between r[k] and r[k + 1],
/// and for the edge across which r[k] lies, which leads to that vertex.
class RowVertices {
 public:
  /// Numbers the vertices of a row in the order of the first of their three edge ends.
  void number(const Row& row) {
    at_end_.resize(row.edge_ends);
    faces_.resize(row.edge_ends / 3);
    if (row.faces <= most_in_table) {
      table_.resize(std::size_t{row.faces} * row.faces);
      numberBy(row, [&](std::size_t face, std::size_t third) -> std::uint32_t& {
        return table_[face * row.faces + third];
      });
    } else {
      sortEnds(row);
      numberBy(row, [&](std::size_t face, std::size_t third) -> std::uint32_t& {
        const std::pair key(std::uint64_t{face} << 32 | third, std::uint32_t{0});
        return std::ranges::lower_bound(sorted_, key)->second;
      });
    }
  }

  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  /// By edge end: its vertex.
  [[nodiscard]] const std::vector<std::uint32_t>& atEnd() const { return at_end_; }
  /// By vertex: its faces, counter-clockwise seen from outside, the first in the row first.
  [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& faces() const { return faces_; }

 private:
  static constexpr std::uint32_t most_in_table = 256;

  /// endOf(f, a) is where the end of the ring of f at which a stands is kept.
  template <class EndOf>
  void numberBy(const Row& row, const EndOf& endOf) {
    for (std::size_t f = 0; f < row.faces; ++f) {
      const Ring ring = row.ring(f);
      const auto begin = static_cast<std::uint32_t>(row.ringBegin(f));
      for (std::uint32_t k = 0; k < ring.size(); ++k) endOf(f, ring[k]) = begin + k;
    }
    std::uint32_t count = 0;
    for (std::uint32_t f = 0; f < row.faces; ++f) {
      const Ring ring = row.ring(f);
      const auto begin = row.ringBegin(f);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const std::size_t a = ring[k], b = ring[k + 1 == ring.size() ? 0 : k + 1];
        if (a < f || b < f) continue;
        at_end_[begin + k] = at_end_[endOf(a, b)] = at_end_[endOf(b, f)] = count;
        faces_[count++] = {f, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)};
      }
    }
  }

  void sortEnds(const Row& row) {
    sorted_.clear();
    for (std::uint64_t f = 0; f < row.faces; ++f) {
      const Ring ring = row.ring(f);
      for (std::size_t k = 0; k < ring.size(); ++k) sorted_.emplace_back(f << 32 | ring[k], 0);
    }
    std::ranges::sort(sorted_);
  }

  std::vector<std::uint32_t> at_end_, table_;
  std::vector<std::array<std::uint32_t, 3>> faces_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted_;
};

}  // namespace vorpipe::space
