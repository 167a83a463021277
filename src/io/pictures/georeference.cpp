#include "io/pictures/georeference.h"

#include <fmt/core.h>

namespace vorpipe {

PixelGrid pixelGridOf(const Box& domain, const PictureFrame& frame) {
  const double width = (domain.xmax - domain.xmin) / frame.width;
  const double height = (domain.ymax - domain.ymin) / frame.height;
  return {domain.xmin - frame.left * width, domain.ymax + frame.top * height, width, height};
}

Result<void> writeWorldFile(ByteSink& sink, const PixelGrid& grid) {
  return sink.write(fmt::format("{}\n0\n0\n{}\n{}\n{}\n", grid.width, -grid.height,
                                grid.left + grid.width / 2, grid.top - grid.height / 2));
}

}  // namespace vorpipe
