#include "io/pictures/georeference.h"

#include <fmt/core.h>

namespace vorpipe {

PixelGrid pixelGridOf(const Box& box, const PictureFrame& frame) {
  const double width = (box.xmax - box.xmin) / frame.width;
  const double height = (box.ymax - box.ymin) / frame.height;
  return {box.xmin - frame.left * width, box.ymax + frame.top * height, width, height};
}

Result<void> writeWorldFile(ByteSink& sink, const PixelGrid& grid) {
  return sink.write(fmt::format("{}\n0\n0\n{}\n{}\n{}\n", grid.width, -grid.height,
                                grid.left + grid.width / 2, grid.top - grid.height / 2));
}

}  // namespace vorpipe
