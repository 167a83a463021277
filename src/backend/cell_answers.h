/// Converts the answers of edges.geom and neighbors.comp of shaders/glsl to CellNeighbors.
#pragma once

#include <cstddef>
#include <cstdint>

#include "backend/backend.h"

namespace vorpipe {

/// The answers for `count` entries, as the device wrote them. Each entry has a word, and a row of int32 with
/// its neighbors. Strides are in bytes.
struct CellAnswers {
  std::size_t count;  ///< entries
  std::size_t room;   ///< for neighbors in a row
  const std::byte* words;
  std::size_t word_stride;
  const std::byte* rows;
  std::size_t row_stride;
};

/// Returns the row length for cells with at most `edges` edges, a multiple of four. With weights, the answer
/// for an empty cell lists the lines that leave nothing of it, which may be edges + 1.
constexpr std::size_t answerRoom(std::size_t edges, bool weighted) { return edges + (weighted ? 4 : 0); }

/// Returns the status in a word; `missing` if it is invalid.
CellStatus statusIn(std::uint32_t word);

/// Reserves memory in an empty `out` for `entries` rows of up to `room` neighbors, so that appending does not
/// move them.
void reserve(std::size_t entries, std::size_t room, CellNeighbors& out);

/// Appends the entries of `answers` to `out`, on all threads. An entry with an invalid word is `missing`.
void append(const CellAnswers& answers, CellNeighbors& out);

/// Appends the entries of `part` to `out`.
void append(const CellNeighbors& part, CellNeighbors& out);

}  // namespace vorpipe
