/// The calls of a backend that are answered, with answers that can be relied on: whatever a device says,
/// every number that comes back from here may be used as an index. Nothing else in core makes these calls.
///
/// A cell that makes no sense comes back as `missing`, so that the judge finds it. An answer that makes no
/// sense as a whole, of another number of cells than were asked for, is an error (device).
///
/// Whether a cell that could be one is right is not seen here: the check of all cells against each other
/// decides that (cell_check.h).
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

/// backend.cells(which, effort, out), where `sites` is the number of the sites that it was given.
Result<void> askCells(Backend& backend, std::size_t sites, std::span<const std::uint32_t> which,
                      Effort effort, int threads, CellNeighbors& out);

/// backend.cells(batch, out).
Result<void> askCells(Backend& backend, const CellBatch<double>& batch, int threads, CellNeighbors& out);

/// backend.draw(which, effort, status).
Result<void> askToDraw(Backend& backend, std::span<const std::uint32_t> which, Effort effort,
                       std::span<CellStatus> status);

/// backend.draw(batch, marks, effort, status).
Result<void> askToDraw(Backend& backend, const CellBatch<float>& batch, std::span<const DrawMark> marks,
                       Effort effort, std::span<CellStatus> status);

/// Validates a picture that a device drew. A pixel whose id is that of no site of the set, or of a site whose
/// status is not `certified`, gets no_site, as if no cell had covered it; every other pixel gets the color of
/// its site from the palette. `status` and `palette_index` are by index in the set. A wrong id that is that
/// of a certified site is not found here.
class PixelCheck {
 public:
  PixelCheck(const SiteSet& sites, std::span<const std::uint8_t> palette_index, int threads);

  void apply(std::span<const CellStatus> status, const Palette& palette, std::span<std::uint32_t> rgba,
             std::span<std::uint32_t> ids);

 private:
  const SiteSet& sites_;
  std::span<const std::uint8_t> palette_index_;
  int threads_;
  std::vector<std::uint16_t>
      shown_;  ///< by id: one more than the palette_index of its site, or 0 without a cell
};

}  // namespace vorpipe::core
