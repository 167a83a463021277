/// Validated versions of the backend calls that return answers. Whatever a device returns, every number from
/// here may be used as an index. Nothing else in core makes these calls.
///
/// An invalid cell is returned as `missing`, so that the exact search finds it. An answer that is invalid as
/// a whole, with a different number of cells than requested, is an error (device).
///
/// These functions do not detect a plausible but wrong cell: the check of all cells against each other does
/// (cell_check.h).
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

/// Calls backend.cells(which, capacity, out); `sites` is the number of sites that the backend was given.
Result<void> askCells(Backend& backend, std::size_t sites, std::span<const std::uint32_t> which,
                      Capacity capacity, int threads, CellNeighbors& out);

/// Calls backend.cells(batch, out).
Result<void> askCells(Backend& backend, const CellBatch<double>& batch, int threads, CellNeighbors& out);

/// Calls backend.draw(which, capacity, status).
Result<void> askToDraw(Backend& backend, std::span<const std::uint32_t> which, Capacity capacity,
                       std::span<CellStatus> status);

/// Calls backend.draw(batch, marks, capacity, status).
Result<void> askToDraw(Backend& backend, const CellBatch<float>& batch, std::span<const DrawMark> marks,
                       Capacity capacity, std::span<CellStatus> status);

/// Validates a picture that a device drew. A pixel gets no_site, as if no cell had covered it, if its id is
/// no site of the set or its site's status is not `certified`. Every other pixel gets its site's color from
/// the palette. `status` and `palette_index` are by index in the set. A wrong id that belongs to a certified
/// site goes undetected.
class PixelCheck {
 public:
  PixelCheck(const SiteSet& sites, std::span<const std::uint8_t> palette_index, int threads);

  void apply(std::span<const CellStatus> status, const Palette& palette, std::span<std::uint32_t> rgba,
             std::span<std::uint32_t> ids);

 private:
  const SiteSet& sites_;
  std::span<const std::uint8_t> palette_index_;
  int threads_;
  std::vector<std::uint16_t> shown_;  ///< by id: palette_index of its site plus 1, or 0 without a cell
};

}  // namespace vorpipe::core
