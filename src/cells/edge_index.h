/// Finds the edge of a cell to a given neighbor.
#pragma once

#include <bit>
#include <span>
#include <utility>
#include <vector>

#include "cells/neighbor_rows.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace vorpipe::core {

/// Finds edges by neighbor, in cells of any number of edges. The cells outlive it unchanged.
class EdgeIndex {
 public:
  EdgeIndex(const NeighborRows& cells, int threads);

  static constexpr std::size_t none = ~std::size_t{0};

  /// The index in `row`, the edges of `cell`, of the edge to `neighbor`; or `none`.
  [[nodiscard]] std::size_t find(std::span<const std::int32_t> row, std::size_t cell,
                                 std::int32_t neighbor) const {
    if (row.size() > most_scanned) return findInLarge(cell, neighbor);
    const auto* edge = row.data();
    if (row.size() <= at_once) {
      const auto first = static_cast<std::size_t>(std::countr_zero(matches(edge, neighbor)));
      return first < row.size() ? first : none;
    }
    for (std::size_t e = 0; e < row.size(); ++e) {
      if (edge[e] == neighbor) return e;
    }
    return none;
  }

 private:
  /// Break-even between a linear scan and a sorted list. Without the list a cell of n neighbors would cost
  /// n^2, since each neighbor looks itself up.
  static constexpr std::size_t most_scanned = NeighborRows::usual_edges;
  static constexpr std::size_t at_once = NeighborRows::readable;

  /// Bit e: whether edge[e] is `neighbor`. Always compares `at_once` edges: reading past the row's end is
  /// cheaper than a mispredicted branch.
  static std::uint32_t matches(const std::int32_t* edge, std::int32_t neighbor) {
#if defined(__SSE2__)
    const auto* four = reinterpret_cast<const __m128i*>(edge);
    const auto wanted = _mm_set1_epi32(neighbor);
    const auto low = _mm_cmpeq_epi32(_mm_loadu_si128(four), wanted);
    const auto high = _mm_cmpeq_epi32(_mm_loadu_si128(four + 1), wanted);
    const auto bytes = _mm_packs_epi16(_mm_packs_epi32(low, high), _mm_setzero_si128());
    return static_cast<std::uint32_t>(_mm_movemask_epi8(bytes));
#else
    std::uint32_t found = 0;
    for (std::size_t e = 0; e < at_once; ++e) found |= std::uint32_t{edge[e] == neighbor} << e;
    return found;
#endif
  }

  struct Large {
    std::size_t cell;
    std::vector<std::pair<std::int32_t, std::uint32_t>> edges;  ///< neighbor and index in the row, ascending
  };
  [[nodiscard]] std::size_t findInLarge(std::size_t cell, std::int32_t neighbor) const;

  std::vector<Large> large_;  ///< ascending
};

}  // namespace vorpipe::core
