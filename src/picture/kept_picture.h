/// What pictures of the same sites and domain have in common, whatever they show of it and in which colors.
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
  FoundCells found;    ///< without cells, a diagram that is empty
  DrawnBefore before;  ///< and the cells, where they were found
  /// The colors last asked for.
  struct Colors {
    ColorBy by;
    ColorScale scale;
    std::optional<ColorRange> range;
    bool legend;
    std::vector<std::uint8_t> index;  ///< by index in the set
    std::optional<ColorKey> key;
  };
  std::optional<Colors> colors{};

  [[nodiscard]] bool hasCells() const { return !found.diagram.status.empty(); }
};

/// Whether the cells of a picture are to be found as data: for measures that the colors follow, and to prove
/// which cells weights and an outline leave. Error (input): the outline is too far from the domain.
Result<bool> needsCells(const Sites& sites, const RenderOptions& options, int threads);

/// Finds what a picture is drawn from: cells, where they are needed, or prepared sites alone. Errors: those
/// of findCells and of prepare.
Result<KeptPicture> findPicture(const Machine& machine, const Sites& sites, const RenderOptions& options,
                                bool with_cells);

/// Colors the sites as the options say, if they are not. Errors: those of paletteIndices.
Result<void> colorPicture(const Sites& sites, const RenderOptions& options, int threads, KeptPicture& kept);

}  // namespace vorpipe::core
