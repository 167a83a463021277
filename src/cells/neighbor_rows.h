/// The neighbors of each cell, whatever found them, and searches in them.
#pragma once

#include <emmintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "backend/backend.h"

#if defined(__SSE2__)
#endif

namespace vorpipe::core {

/// The edges after and before edge e of a row.
inline std::size_t edgeAfter(std::span<const std::int32_t> row, std::size_t e) {
  return e + 1 < row.size() ? e + 1 : 0;
}
inline std::size_t edgeBefore(std::span<const std::int32_t> row, std::size_t e) {
  return e > 0 ? e - 1 : row.size() - 1;
}

/// Sorts numbers and drops repeated ones.
inline void sortWithoutRepeats(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

inline bool isDone(CellStatus status) {
  return status == CellStatus::certified || status == CellStatus::empty;
}

/// The rows of cells 0 to size() - 1, added in any order and in parts of any size: the edges of a cell,
/// counter-clockwise, each by the neighbor on its other side. Rows stay in the memory of the part that added
/// them; only the last row added for a cell is visible.
class NeighborRows {
 public:
  /// A cell that was never added is `missing` and has no edges.
  explicit NeighborRows(std::size_t cells, int threads);
  // A copy's rows would point into the original's memory.
  NeighborRows(const NeighborRows&) = delete;
  NeighborRows(NeighborRows&&) = default;
  NeighborRows& operator=(const NeighborRows&) = delete;
  NeighborRows& operator=(NeighborRows&&) = default;
  ~NeighborRows() = default;

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] CellStatus status(std::size_t cell) const { return rows_[cell].status; }

  /// This many numbers can be read from the start of a row, even if it is shorter.
  static constexpr std::size_t readable = 8;
  [[nodiscard]] std::span<const std::int32_t> edges(std::size_t cell) const {
    return {rows_[cell].edges, rows_[cell].count};
  }

  /// Entry e of `found` becomes cell which[e].
  void add(std::span<const std::uint32_t> which, CellNeighbors found);
  void add(std::span<const std::uint32_t> which, NeighborRows found);

  /// Removes the edges of a cell. Threads may do this for different cells at the same time.
  void drop(std::size_t cell, CellStatus status) { rows_[cell] = {nothing.data(), 0, status}; }

  /// Cells with more edges than this are few; large() returns them.
  static constexpr std::size_t usual_edges = 64;
  /// Those cells, ascending.
  [[nodiscard]] std::vector<std::uint32_t> large() const;

 private:
  struct Row {
    const std::int32_t* edges;
    std::uint32_t count;
    CellStatus status;
  };
  static constexpr std::array<std::int32_t, readable> nothing{};

  void makeReadable(std::span<const std::uint32_t> which, const CellNeighbors& found);

  BigVector<Row> rows_;
  std::vector<BigVector<std::int32_t>> parts_;
  std::vector<std::uint32_t> large_;  ///< cells with large rows, and some whose rows once were large
  int threads_;
};

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

/// Calls each(cell) for cellAt(begin) to cellAt(end - 1), those with few edges first. In this order the
/// branches that end loops over edges are predicted, and cells of equal size can be handled in one vectorized
/// batch.
template <class CellAt, class Each>
void forCellsBySize(const NeighborRows& cells, std::size_t begin, std::size_t end, const CellAt& cellAt,
                    const Each& each) {
  constexpr std::size_t most = 64;
  const auto sizeOf = [&](std::uint32_t cell) {
    return std::min<std::size_t>(cells.edges(cell).size(), most);
  };
  std::array<std::uint32_t, most + 2> next{};
  for (auto k = begin; k < end; ++k) ++next[sizeOf(cellAt(k)) + 1];
  for (std::size_t size = 0; size < most; ++size) next[size + 1] += next[size];
  std::vector<std::uint32_t> order(end - begin);
  for (auto k = begin; k < end; ++k) order[next[sizeOf(cellAt(k))]++] = cellAt(k);
  for (const auto cell : order) each(cell);
}

}  // namespace vorpipe::core
