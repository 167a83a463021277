/// What render makes: a picture in pixels, the cells that shapes are made of, or both.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::cli {

struct Drawing {
  std::optional<Rendering> pixels;
  std::optional<Diagram> cells;   ///< with Detail::polygons
  std::optional<ColorKey> key{};  ///< what colors stand for; none by site

  /// Of the picture in pixels, if there is one.
  [[nodiscard]] const Report& report() const { return pixels ? pixels->report : cells->report; }
  /// By site, in input order.
  [[nodiscard]] const std::vector<Status>& status() const { return pixels ? pixels->status : cells->status; }
};

/// What is to be made, at least one of them.
struct DrawingNeeds {
  bool pixels = true, cells = false;
};

/// The options of the cells that a picture's shapes are made of.
CellsOptions shapesOptions(const RenderOptions& picture);

/// Makes what is needed. Errors: those of Session::render, Session::cells and siteColors.
Result<Drawing> draw(Session& session, const Sites& sites, const RenderOptions& options,
                     const DrawingNeeds& needs);

/// Promises of what was made that are broken. Error: check()'s.
Result<std::vector<std::string>> checkDrawing(const Sites& sites, const RenderOptions& options,
                                              const Drawing& drawing, int threads);

/// Plans draw(), and checkDrawing() where `checks`; then what writers of shapes take.
void planDrawing(MemoryPlan& plan, const Workload& work, const RenderOptions& options,
                 const DrawingNeeds& needs, bool checks);

/// The same after a run of steps, without checks.
void planDrawingAfterSteps(MemoryPlan& plan, const Workload& work, const RenderOptions& options,
                           const DrawingNeeds& needs);

}  // namespace vorpipe::cli
