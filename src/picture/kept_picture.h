/// Shared data of pictures of the same sites and domain, whatever part they show and in which colors.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "domain/cells_run.h"
#include "domain/rings.h"
#include "picture/cell_drawing.h"

namespace vorpipe::core {

struct KeptPicture {
  Rings rings;
  FoundCells found;    ///< its diagram is empty if cells were not found
  DrawnBefore before;  ///< and the cells, if they were found
  /// The last requested colors.
  struct Colors {
    ColorBy by;
    ColorScale scale;
    std::optional<ColorRange> range;
    bool legend;
    SiteValues values;
    std::size_t own_colors;           ///< how many names have a color depends on it
    std::vector<std::uint8_t> index;  ///< by index in the set
    std::optional<ColorKey> key;
  };
  std::optional<Colors> colors{};

  [[nodiscard]] bool hasCells() const { return !found.diagram.status.empty(); }
};

/// Whether a picture needs its cells as data: for measures that the colors show, or to prove which cells
/// remain with weights and an outline. Error (input): the outline is too far from the domain.
Result<bool> needsCells(const Sites& sites, const RenderOptions& options, int threads);

/// Finds the input of a picture: cells if they are needed, else only prepared sites. Errors: those of
/// findCells and of prepare.
Result<KeptPicture> findPicture(const Machine& machine, const Sites& sites, const RenderOptions& options,
                                bool with_cells);

/// Colors the sites by the options, unless that is done already. Errors: those of paletteIndices.
Result<void> colorPicture(const Sites& sites, const RenderOptions& options, int threads, KeptPicture& kept);

}  // namespace vorpipe::core
