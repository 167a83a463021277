/// Pictures of cells as SVG.
#pragma once

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Draws `diagram`, the cells of `sites` with Detail::polygons, by `options`, and writes the picture as SVG
/// 1.1 of options.width x options.height pixels. Each cell is a path with its site and area as title. Equal
/// cells give equal bytes. Errors: those of VectorPicture::make; writing failed or memory ran out (device).
Result<void> writeSvgPicture(ByteSink& sink, const Sites& sites, const Diagram& diagram,
                             const RenderOptions& options, int threads = 0);

}  // namespace vorpipe
