/// The vertices of one cell, numbered by its row alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "space/rows.h"

namespace vorpipe::space {

/// Where a ring has its least face.
template <class Entries>
std::size_t leastIn(const Entries& ring, std::size_t size) {
  std::size_t least = 0;
  for (std::size_t k = 1; k < size; ++k) least = ring[k] < ring[least] ? k : least;
  return least;
}

/// Numbers the vertices of rows, one row after another. An edge end is a place in the rings of a row, all put
/// behind one another: number e of face f's ring r, at k, stands for the vertex between r[k] and r[k + 1],
/// and for the edge across which r[k] lies, which leads to that vertex.
class RowVertices {
 public:
  /// Numbers the vertices of a row in the order of the first of their three edge ends.
  void number(const Row& row) {
    numberFrom(row, [](const auto*, std::size_t) { return std::size_t{0}; });
  }
  /// Numbers them as if each ring began with its least face.
  void numberFromLeast(const Row& row) {
    numberFrom(row, [](const auto* ring, std::size_t size) { return leastIn(ring, size); });
  }

  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  /// By edge end: its vertex.
  [[nodiscard]] const std::vector<std::uint32_t>& atEnd() const { return at_end_; }
  /// By vertex: its faces, counter-clockwise seen from outside, the first in the row first.
  [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& faces() const { return faces_; }

 private:
  static constexpr std::uint32_t most_in_table = 256;

  template <class FirstOf>
  void numberFrom(const Row& row, const FirstOf& firstOf) {
    at_end_.resize(row.edge_ends);
    // One more, which is written before it is known to be no vertex.
    faces_.resize(row.edge_ends / 3 + 1);
    first_end_.resize(row.edge_ends / 3 + 1);
    if (row.faces <= most_in_table) {
      table_.resize(std::size_t{row.faces} * row.faces);
      const auto endOf = [table = table_.data(), faces = row.faces](std::size_t face,
                                                                    std::size_t third) -> std::uint32_t& {
        return table[face * faces + third];
      };
      row.isSmall() ? numberBy(row.faces, row.small_begin, row.small, firstOf, endOf)
                    : numberBy(row.faces, row.large_begin, row.large, firstOf, endOf);
    } else {
      sortEnds(row);
      numberBy(row.faces, row.large_begin, row.large, firstOf,
               [this](std::size_t face, std::size_t third) -> std::uint32_t& {
                 const std::pair key(std::uint64_t{face} << 32 | third, std::uint32_t{0});
                 return std::ranges::lower_bound(sorted_, key)->second;
               });
    }
    faces_.pop_back();
  }

  /// endOf(f, a) is where the end of the ring of f at which a stands is kept.
  template <class Number, class Entry, class FirstOf, class EndOf>
  void numberBy(std::uint32_t faces, const Number* begin, const Entry* rings, const FirstOf& firstOf,
                const EndOf& endOf) {
    for (std::uint32_t f = 0; f < faces; ++f) {
      for (std::uint32_t e = begin[f]; e < begin[f + 1]; ++e) endOf(f, rings[e]) = e;
    }
    std::uint32_t count = 0;
    auto* const of = faces_.data();
    auto* const first = first_end_.data();
    for (std::uint32_t f = 0; f < faces; ++f) {
      const Entry* const ring = rings + begin[f];
      const std::size_t size = begin[f + 1] - begin[f], from = firstOf(ring, size);
      // Whether a vertex is new is hard to foresee: no branch.
      const auto visit = [&](std::size_t k, std::uint32_t a, std::uint32_t b) {
        of[count] = {f, a, b};
        first[count] = static_cast<std::uint32_t>(begin[f] + k);
        count += a > f && b > f ? 1 : 0;
      };
      for (std::size_t k = from; k + 1 < size; ++k) visit(k, ring[k], ring[k + 1]);
      visit(size - 1, ring[size - 1], ring[0]);
      for (std::size_t k = 0; k < from; ++k) visit(k, ring[k], ring[k + 1]);
    }
    for (std::uint32_t v = 0; v < count; ++v) {
      const auto [f, a, b] = of[v];
      at_end_[first[v]] = at_end_[endOf(a, b)] = at_end_[endOf(b, f)] = v;
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

  std::vector<std::uint32_t> at_end_, table_, first_end_;
  std::vector<std::array<std::uint32_t, 3>> faces_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted_;
};

}  // namespace vorpipe::space
