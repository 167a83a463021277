/// The result of render: a picture in pixels, the cells for shapes, or both.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::cli {

struct Drawing {
  std::optional<Rendering> pixels;
  std::optional<Diagram> cells;   ///< with Detail::polygons
  std::optional<ColorKey> key{};  ///< what the colors mean; none if by site

  /// The report of the pixel picture if there is one, else of the cells.
  [[nodiscard]] const Report& report() const { return pixels ? pixels->report : cells->report; }
  /// The status of each site, in input order.
  [[nodiscard]] const std::vector<Status>& status() const { return pixels ? pixels->status : cells->status; }
};

/// What to make: at least one of these.
struct DrawingNeeds {
  bool pixels = true, cells = false;
};

/// Returns the options of the cells for a picture's shapes.
CellsOptions shapesOptions(const RenderOptions& picture);

/// Makes the needed parts. Errors: those of Session::render, Session::cells and siteColors.
Result<Drawing> draw(Session& session, const Sites& sites, const RenderOptions& options,
                     const DrawingNeeds& needs);

/// Returns the broken promises of a drawing. Error: check()'s.
Result<std::vector<std::string>> checkDrawing(const Sites& sites, const RenderOptions& options,
                                              const Drawing& drawing, int threads);

/// Plans the memory of draw(), of checkDrawing() if `checks`, then of the writers of shapes.
void planDrawing(MemoryPlan& plan, const Workload& work, const RenderOptions& options,
                 const DrawingNeeds& needs, bool checks);

/// The same after a run of steps, without checks.
void planDrawingAfterSteps(MemoryPlan& plan, const Workload& work, const RenderOptions& options,
                           const DrawingNeeds& needs);

}  // namespace vorpipe::cli
