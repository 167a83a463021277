/// Draws cells from lists of sites and from lines.
#pragma once

#include "backend/backend.h"
#include "core/search/candidates.h"

namespace vorpipe::core {

/// What a drawing works with; all of it outlives the drawing.
struct Canvas {
  Backend& backend;
  const SiteSet& sites;
  std::span<const std::uint8_t> palette_index;  ///< by index in the set
  int threads;
};

/// Entries of one batch, each a cell or a piece of one.
struct Pieces {
  std::vector<std::uint32_t> site;  ///< by entry
  CellBatch<float> batch;
  double tolerance;  ///< by how much they may be larger than the cell, in scaled units
};

class BatchDrawing {
 public:
  explicit BatchDrawing(const Canvas& canvas) : canvas_(canvas) {}

  /// Draws every entry of `candidates`, in as many batches as the device wants. Returns the status of each:
  /// `missing` for a list that is longer than a batch; `unsecured` as well for a cell without walls of its
  /// own that is so large that floats might lose more of it than shows. One with walls is shrunk by so much.
  Result<std::vector<CellStatus>> draw(const View& view, const Candidates& candidates, Effort effort);

  /// Draws what the device can of the entries.
  Result<void> draw(const View& view, Pieces pieces);

  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  Result<void> drawBatch(const View& view, const CellBatch<float>& batch, std::span<const std::uint32_t> site,
                         Effort effort, std::span<CellStatus> status);

  Canvas canvas_;
  std::vector<DrawMark> marks_;
  CellBatch<float> batch_;
  double seconds_ = 0;
};

}  // namespace vorpipe::core
