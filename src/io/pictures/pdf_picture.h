/// Pictures of cells as PDF.
#pragma once

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Draws `diagram`, the cells of `sites` with Detail::polygons, by `options`, and writes the picture as one
/// page of PDF 1.4. A pixel is 0.75 points, as in browsers, or less if the page would exceed 14400 points,
/// the most that readers accept. Equal cells give equal bytes. Errors: those of VectorPicture::make; writing
/// failed or memory ran out (device).
Result<void> writePdfPicture(ByteSink& sink, const Sites& sites, const Diagram& diagram,
                             const RenderOptions& options, int threads = 0);

}  // namespace vorpipe
