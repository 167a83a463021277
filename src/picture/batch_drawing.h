/// Draws cells from lists of sites.
#pragma once

#include "cells/bisectors.h"
#include "picture/canvas.h"

namespace vorpipe::core {

class BatchDrawing {
 public:
  explicit BatchDrawing(const Canvas& canvas) : canvas_(canvas) {}

  /// Draws every entry of `candidates`, in as many batches as the device needs. Returns the status of each
  /// entry: `missing` for a list that is longer than a batch. Also `unsecured` for a cell so large that float
  /// rounding might visibly change it.
  Result<std::vector<CellStatus>> draw(const View& view, const Candidates& candidates, Effort effort);

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
