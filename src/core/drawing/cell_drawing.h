/// Draws every cell of a diagram on a backend, and redoes cells until each is certified.
#pragma once

#include <optional>

#include "core/drawing/batch_drawing.h"
#include "core/drawing/polygon_drawing.h"
#include "core/judge/answers.h"
#include "core/search/device_ladder.h"

namespace vorpipe::core {

/// Cells that are known already are drawn as polygons. Else the device finds and draws what it can; the judge
/// finds the rest, and then these are known. Cells are drawn in an order that depends on nothing but the
/// sites.
class CellDrawing {
 public:
  /// `palette_index` is by index in the set; `known` is all cells, by index in the set, or nothing.
  CellDrawing(const SearchInput& input, std::span<const std::uint8_t> palette_index,
              std::optional<NeighborRows> known);

  /// Begins a picture on the backend and draws all cells into it.
  Result<void> draw(const View& view);

  /// Reads the picture of the view that was drawn last. A pixel that no cell covers, or that a device says is
  /// of a site without one, has no_site and color 0.
  Result<void> read(const View& view, std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids);

  /// certified or empty, by index in the set.
  [[nodiscard]] const std::vector<CellStatus>& status() const { return status_; }

  /// Adds how many cells took which way, and the times.
  void describe(Report& report) const;

 private:
  void take(NeighborRows known);
  Result<void> giveAll();
  Result<void> climb(const View& view);

  SearchInput input_;
  Upload upload_;
  bool all_known_;  ///< from the start
  CellLadder ladder_;
  BatchDrawing batches_;
  PolygonDrawing polygons_;
  std::vector<KnownCells> known_;
  std::vector<CellStatus> status_;
  PixelCheck pixels_;
  double grid_seconds_ = 0;
};

}  // namespace vorpipe::core
