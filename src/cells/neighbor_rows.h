/// The neighbors of each cell, whatever found them.
#pragma once

#include <array>

#include "backend/backend.h"

namespace vorpipe::core {

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
  std::vector<std::uint32_t> large_;  ///< and some that once were
  int threads_;
};

/// The cells of some sites; entry e of `found`, certified or empty, is the cell of which[e].
struct KnownCells {
  std::vector<std::uint32_t> which;
  NeighborRows found;
};

/// The sites among `which` whose entries in `status` have one of the wanted statuses.
template <class Wanted>
std::vector<std::uint32_t> withStatus(std::span<const std::uint32_t> which,
                                      const std::vector<CellStatus>& status, const Wanted& wanted) {
  std::vector<std::uint32_t> found;
  for (std::size_t e = 0; e < which.size(); ++e) {
    if (wanted(status[e])) found.push_back(which[e]);
  }
  return found;
}

}  // namespace vorpipe::core
