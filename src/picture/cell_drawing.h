/// Draws every cell of a diagram on a backend, and redoes cells until each is certified.
#pragma once

#include <optional>

#include "cells/answers.h"
#include "cells/device_ladder.h"
#include "picture/batch_drawing.h"
#include "picture/polygon_drawing.h"

namespace vorpipe::core {

/// What drawings of the same set find out, and the next one need not: it says nothing of what they showed.
/// Which cell is drawn in which way depends on the drawing alone, so that no pixel depends on those before.
struct DrawnBefore {
  /// All cells, by index in the set, where they were known before anything was drawn.
  std::optional<NeighborRows> known{};
  std::optional<Triage> triage{};
  std::optional<NeighborRows> judged{};  ///< what the judge found, by index in the set; `missing`: not asked
  std::vector<CellStatus> status{};      ///< certified or empty, by index in the set
  HeldSites held{};
  bool done = false;  ///< a drawing of all cells came to its end
};

/// What is to be drawn.
struct WhatToDraw {
  /// The only sites, ascending, whose cells show; all if there are none. Every other site inside the domain
  /// has a cell, since it lies in it itself.
  std::optional<std::vector<std::uint32_t>> shown{};
  bool by_device = true;  ///< floats can tell the view's pixels apart
};

/// Cells that are known already are drawn as polygons. Else the device finds and draws what it can; the judge
/// finds the rest, and then these are known. Cells are drawn in an order that depends on nothing but the
/// sites.
class CellDrawing {
 public:
  /// `palette_index` is by index in the set; all of it outlives this.
  CellDrawing(const SearchInput& input, std::span<const std::uint8_t> palette_index, WhatToDraw what,
              DrawnBefore& before);

  /// Begins a picture on the backend and draws the cells into it.
  Result<void> draw(const View& view);

  /// Reads the picture of the view that was drawn last. A pixel that no cell covers, or that a device says is
  /// of a site without one, has no_site and color 0.
  Result<void> read(const View& view, std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids);

  /// Finds out which sites have cells where no view is drawn.
  Result<void> findStatuses();

  /// Adds how many cells took which way, and the times.
  void describe(Report& report) const;

 private:
  void choose();
  Result<void> giveAll();
  Result<void> climb(const View& view);
  Result<void> judge(std::span<const std::uint32_t> which);

  SearchInput input_;
  DrawnBefore& before_;
  WhatToDraw what_;
  Upload upload_;
  CellLadder ladder_;
  BatchDrawing batches_;
  PolygonDrawing polygons_;
  std::vector<std::uint32_t> as_polygons_;  ///< the cells that are not the device's
  PixelCheck pixels_;
  double grid_seconds_ = 0;
};

/// Whether floats tell the pixels of a view apart, seen from the center of a domain whose longer side is 1 to
/// 2: devices hold places to 48 binary digits.
bool isForDevices(const View& view);

}  // namespace vorpipe::core
