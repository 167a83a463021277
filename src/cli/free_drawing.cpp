#include "cli/free_drawing.h"

#include <fmt/format.h>

#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::cli {

Result<void> checkDiscs(const Sites& sites) {
  if (!sites.weight.empty()) return {};
  return inputError("--surface: the sites have no weights, which are the squared radii of their discs");
}

Result<void> checkFreePicture(std::string_view option, const RenderOptions& options,
                              const DrawingNeeds& needs) {
  if (!needs.pixels) return {};
  const bool over_air = options.legend || options.labels || options.dual || options.show_sites;
  // Pixels get the colors of cells that fill the domain.
  const bool of_cells = options.color == ColorBy::area || options.color == ColorBy::neighbors;
  if (!over_air && !of_cells) return {};
  return inputError(
      fmt::format("{}: with a free surface, pictures of pixels have no legend, labels, dual, sites or colors "
                  "by area and neighbors; .svg and .pdf have them",
                  option));
}

Result<Drawing> drawFree(Session& session, const Sites& sites, const RenderOptions& options,
                         const DrawingNeeds& needs) {
  Drawing drawing;
  if (needs.cells) {
    auto cells = freeCells(session, sites, shapesOptions(options));
    if (!cells) return tl::unexpected(std::move(cells.error()));
    drawing.cells = std::move(*cells);
  }
  if (needs.pixels) {
    auto pixels = session.render(sites, options);
    if (!pixels) return tl::unexpected(std::move(pixels.error()));
    VORPIPE_TRY(takeOutAir(sites, options, pixels->image, session.threads()));
    drawing.pixels = std::move(*pixels);
  }
  return drawing;
}

}  // namespace vorpipe::cli
