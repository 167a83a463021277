#include "cli/drawing.h"

#include <utility>

#include "base/try.h"
#include "io/cells/forecast_files.h"
#include "vorpipe/shapes.h"

namespace vorpipe::cli {

CellsOptions shapesOptions(const RenderOptions& picture) {
  CellsOptions cells = cellsOptions(picture);
  cells.detail = Detail::polygons;
  return cells;
}

Result<Drawing> draw(Session& session, const Sites& sites, const RenderOptions& options,
                     const DrawingNeeds& needs) {
  Drawing drawing;
  if (needs.pixels) {
    auto pixels = session.render(sites, options);
    if (!pixels) return tl::unexpected(std::move(pixels.error()));
    drawing.pixels = std::move(*pixels);
    drawing.key = drawing.pixels->key;
  }
  if (needs.cells) {
    auto cells = session.cells(sites, shapesOptions(options));
    if (!cells) return tl::unexpected(std::move(cells.error()));
    drawing.cells = std::move(*cells);
  }
  if (!needs.pixels) {
    auto colors = siteColors(sites, *drawing.cells, options);
    if (!colors) return tl::unexpected(std::move(colors.error()));
    drawing.key = std::move(colors->key);
  }
  return drawing;
}

Result<std::vector<std::string>> checkDrawing(const Sites& sites, const RenderOptions& options,
                                              const Drawing& drawing, int threads) {
  std::vector<std::string> broken;
  const auto take = [&](Result<std::vector<std::string>> found) -> Result<void> {
    if (!found) return tl::unexpected(std::move(found.error()));
    broken.insert(broken.end(), found->begin(), found->end());
    return {};
  };
  if (drawing.pixels) {
    VORPIPE_TRY(take(check(sites, options, *drawing.pixels, threads)));
  }
  if (drawing.cells) {
    VORPIPE_TRY(take(check(sites, shapesOptions(options), *drawing.cells, threads)));
  }
  return broken;
}

void planDrawing(MemoryPlan& plan, const Workload& work, const RenderOptions& options,
                 const DrawingNeeds& needs, bool checks) {
  if (needs.pixels) planPicture(plan, work, options);
  if (needs.cells) planCells(plan, work, Detail::polygons);
  if (checks && needs.pixels) planPictureCheck(plan, work, options);
  if (checks && needs.cells) planCellsCheck(plan, work, Detail::polygons);
  if (needs.cells) planShapes(plan, work, options);
}

void planDrawingAfterSteps(MemoryPlan& plan, const Workload& work, const RenderOptions& options,
                           const DrawingNeeds& needs) {
  constexpr std::uint64_t gaps = 8'000'000;
  plan.take("gaps that steps left", gaps);
  planDrawing(plan, work, options, needs, /*checks=*/false);
}

}  // namespace vorpipe::cli
