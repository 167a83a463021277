/// Pictures of an input: what to draw, and the result in pixels, as cells for shapes, or both.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/input.h"
#include "cli/options/picture_options.h"
#include "io/sites/photograph_file.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Returns what to draw of an input. Errors (input), which name the option: options contradict each other or
/// the input.
Result<RenderOptions> pictureOf(const PictureOptions& picture, const InputOptions& sites, const Input& input);

/// Reads the photograph that --color names, if any; adds notes on its place to the input. Errors: those of
/// readPhotograph and placePhotograph.
Result<PhotographFile> photographOf(const PictureOptions& picture, const InputOptions& sites, Input& input);

/// Gives the picture of these sites the colors of a photograph, if there is one. Errors: those of
/// photographColors.
Result<void> takeColors(const PhotographFile& photograph, const Sites& sites, int threads,
                        RenderOptions& options);

/// Returns a note that a picture stretches its domain, and how to avoid that. Empty if it does not, or if
/// --fit requested it.
std::string stretchNote(const PictureOptions& picture, const RenderOptions& options);

struct Drawing {
  std::optional<Rendering> pixels;
  std::optional<Diagram> cells;   ///< with Detail::polygons
  std::optional<ColorKey> key{};  ///< what the colors mean; none if by site, or with a free surface

  /// The report of the pixel picture if there is one, else of the cells.
  [[nodiscard]] const Report& report() const { return pixels ? pixels->report : cells->report; }
  /// The status of each site, in input order.
  [[nodiscard]] const std::vector<Status>& status() const { return pixels ? pixels->status : cells->status; }
};

/// What to make: at least one of these.
struct DrawingNeeds {
  bool pixels = true, cells = false;
};

/// Error (input): the sites have no weights, so their discs have no radii.
Result<void> checkDiscs(const Sites& sites);

/// Error (input), in words that begin with the option: a picture has marks or colors that pictures with a
/// free surface cannot have in pixels.
Result<void> checkFreePicture(std::string_view option, const RenderOptions& options,
                              const DrawingNeeds& needs);

/// Computes cells; with a free surface, their parts inside the discs around the sites. Errors: those of
/// Session::cells and freeCells.
Result<Diagram> cellsWith(Surface surface, Session& session, const Sites& sites, const CellsOptions& options);

/// Makes the needed parts of such cells. Errors: those of cellsWith, Session::render, siteColors and
/// takeOutAir.
Result<Drawing> draw(Surface surface, Session& session, const Sites& sites, const RenderOptions& options,
                     const DrawingNeeds& needs);

/// Returns the broken promises of a drawing. Error: check()'s.
Result<std::vector<std::string>> checkDrawing(const Sites& sites, const RenderOptions& options,
                                              const Drawing& drawing, int threads);

/// Plans the memory of draw(), of checkDrawing() if `checks`, then of the writers of shapes.
void planDrawing(MemoryPlan& plan, const Workload& work, const RenderOptions& options,
                 const DrawingNeeds& needs, bool checks);

/// Plans the memory of takeColors(), besides the photograph, if there is one.
void planColors(MemoryPlan& plan, const Workload& work, const PictureOptions& picture);

/// As planDrawing after a run of steps, without checks; `domain` if known.
void planDrawingAfterSteps(MemoryPlan& plan, const Workload& work, const PictureOptions& picture,
                           const std::optional<Box>& domain, const DrawingNeeds& needs);

}  // namespace vorpipe::cli
