/// Draws every cell of a diagram on a backend, and redoes cells until each is certified.
#pragma once

#include <memory>
#include <optional>

#include "core/drawing/grid_drawing.h"
#include "core/drawing/list_drawing.h"
#include "core/drawing/polygon_drawing.h"
#include "core/judge/answers.h"
#include "core/judge/judge.h"

namespace vorpipe::core {

/// What a drawing works with; all of it outlives the drawing.
struct DrawingInput {
  Backend& backend;
  Judge& judge;  ///< of the same sites; finds in double what the backend does not certify
  const SiteSet& sites;
  std::span<const std::uint8_t> palette_index;  ///< by index in the set
  const SearchOptions& search;
  int threads;
  const Progress& progress;
  bool several_views;  ///< draw is called more than once
};

/// Cells that are known already are drawn from the sites that bound them. Else the device finds and draws
/// what it can; the judge finds the rest, which is drawn in the same way as known ones. Cells are drawn in an
/// order that depends on nothing but the sites.
class CellDrawing {
 public:
  /// `known`: all cells, by index in the set, or nothing.
  CellDrawing(const DrawingInput& input, std::optional<NeighborRows> known);

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
  using Indices = std::vector<std::uint32_t>;

  Result<void> prepare();
  void take(NeighborRows known);
  Result<void> giveAll();
  void leaveHidden(Indices& which);
  Result<void> judge(Indices which);

  DrawingInput input_;
  Upload upload_;
  bool all_known_;                      ///< all cells were, from the start
  std::unique_ptr<ListDrawing> lists_;  ///< one of these two, unless they were
  std::unique_ptr<GridDrawing> grid_;
  PolygonDrawing polygons_;
  Indices on_device_;                    ///< what the device finds, ascending
  std::vector<KnownCells> known_cells_;  ///< what it does not
  std::vector<CellStatus> status_;
  PixelCheck pixels_;
  std::uint64_t in_double_ = 0;
  std::uint64_t exact_ = 0;
  double tree_seconds_ = 0;
  double judge_seconds_ = 0;
};

}  // namespace vorpipe::core
