/// Draws every cell of a diagram on a backend, and redoes cells until each is certified.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "cells/answers.h"
#include "cells/bisectors.h"
#include "cells/device_ladder.h"
#include "cells/neighbor_rows.h"

namespace vorpipe::core {

/// Results of a drawing that later drawings of the same set reuse. They say nothing of what those drawings
/// showed. Which cell is drawn in which way depends on the drawing alone, so no pixel depends on earlier
/// drawings.
struct DrawnBefore {
  /// All cells, by index in the set, if they were known before any drawing.
  std::optional<NeighborRows> known{};
  std::optional<Triage> triage{};
  std::optional<NeighborRows>
      found_exactly{};  ///< results of the exact search, by index in the set; `missing`: not asked
  std::vector<CellStatus> status{};  ///< certified or empty, by index in the set
  HeldSites held{};
  bool done = false;  ///< a drawing of all cells has finished
};

/// Selects what to draw.
struct WhatToDraw {
  /// The sites, ascending, whose cells show; all sites if not set. Every other site inside the domain also
  /// has a cell, since it lies in it.
  std::optional<std::vector<std::uint32_t>> shown{};
  bool by_device = true;  ///< floats can distinguish the view's pixels
};

/// Draws known cells as polygons. Otherwise the device finds and draws what it can. The exact search finds
/// the rest, which are then drawn as known cells. The order of drawing depends only on the sites.
class CellDrawing {
 public:
  /// `palette_index` is by index in the set. All arguments must live as long as this object.
  CellDrawing(const SearchInput& input, std::span<const std::uint8_t> palette_index, WhatToDraw what,
              DrawnBefore& before);

  /// Begins a picture on the backend and draws the cells into it.
  Result<void> draw(const View& view);

  /// Reads the picture of the last view. A pixel gets no_site and color 0 if no cell covers it, or if the
  /// device assigns it to a site without a cell.
  Result<void> read(const View& view, std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids);

  /// Finds which sites have cells, if no view is drawn.
  Result<void> findStatuses();

  /// Adds the number of cells per method, and the times.
  void describe(Report& report) const;

 private:
  void choose();
  Result<void> giveAll();
  Result<void> drawByDevice(const View& view);
  Result<void> drawLists(const View& view, const Candidates& candidates, Capacity capacity,
                         std::span<CellStatus> status);
  Result<void> drawBatch(const View& view, std::span<const std::uint32_t> site, Capacity capacity,
                         std::span<CellStatus> status);
  Result<void> searchExactly(std::span<const std::uint32_t> which);

  SearchInput input_;
  std::span<const std::uint8_t> palette_index_;
  DrawnBefore& before_;
  WhatToDraw what_;
  Upload upload_;
  CellLadder ladder_;
  std::vector<std::uint32_t> as_polygons_;  ///< the cells that the device does not find
  PixelCheck pixels_;
  std::vector<DrawMark> marks_;  ///< of a batch
  CellBatch<float> batch_;
  double draw_seconds_ = 0;
};

/// Draws the certified cells of the sites `which` as polygons, split into triangles, over the present
/// picture; `cells` holds them by index in the set. Adjacent cells have the same corners, so that there are
/// no gaps. If the device's grid of vertices is coarse, cells shrink by the distance that corners may move,
/// and leave pixels uncovered. Adds the device's time to `seconds`. Errors: the device's; progress said stop.
Result<void> drawPolygons(const SearchInput& input, std::span<const std::uint8_t> palette_index,
                          const View& view, std::span<const std::uint32_t> which, const NeighborRows& cells,
                          double& seconds);

/// Whether floats can distinguish the pixels of a view, relative to the center of a domain whose longer side
/// is 1 to 2. Devices store places with 48 binary digits.
bool isForDevices(const View& view);

}  // namespace vorpipe::core
