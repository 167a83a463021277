/// What edges.geom and neighbors.comp of shaders/glsl answer, as neighborhoods.
#pragma once

#include <cstddef>
#include <cstdint>

#include "backend/backend.h"

namespace vorpipe {

/// The answers for some entries, where the device left them: a word for each, and a row of int32 with
/// the neighbors of each. Strides are in bytes.
struct CellAnswers {
  std::size_t count;  ///< entries
  std::size_t room;   ///< for neighbors in a row
  const std::byte* words;
  std::size_t word_stride;
  const std::byte* rows;
  std::size_t row_stride;
};

/// The numbers in a row of edges.geom with room for so many edges, in fours: with weights, the lines that
/// leave nothing of a cell are one more than that.
constexpr std::size_t answerRoom(std::size_t edges, bool weighted) { return edges + (weighted ? 4 : 0); }

/// The status in a word; `missing` if it makes no sense.
CellStatus statusIn(std::uint32_t word);

/// Makes room in an empty `out` for so many entries with rows of `room` numbers, so that none of it moves
/// later.
void reserve(std::size_t entries, std::size_t room, CellNeighbors& out);

/// Appends the entries to out, on all threads. A word that makes no sense is an entry that is `missing`.
void append(const CellAnswers& answers, CellNeighbors& out);

/// Appends the entries of part to out.
void append(const CellNeighbors& part, CellNeighbors& out);

}  // namespace vorpipe
