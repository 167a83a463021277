/// Pictures of cells as PDF.
#pragma once

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Writes the picture that `options` draw of `diagram`, the cells of `sites` with Detail::polygons, as one
/// page of PDF 1.4. A pixel is 0.75 points, as in browsers, or less where the page would be longer than 14400
/// points, which readers take. Equal cells give equal bytes. Errors: those of VectorPicture::make; writing
/// failed or memory ran out (device).
Result<void> writePdfPicture(ByteSink& sink, const Sites& sites, const Diagram& diagram,
                             const RenderOptions& options, int threads = 0);

}  // namespace vorpipe
