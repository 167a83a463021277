#include "domain/polygon_mass.h"

namespace vorpipe::core {

std::optional<double> PolygonScale::begin(Point origin, const Box& around) {
  const auto &x = pixels_.x, &y = pixels_.y;
  around_ = around;
  const Point offset{x.pixelsTo(origin.x + around.xmin), y.pixelsTo(origin.y + around.ymin)};
  const PixelRows::Range columns{x.at(offset.x), x.at(x.pixelsTo(origin.x + around.xmax))};
  const PixelRows::Range rows{y.at(offset.y), y.at(y.pixelsTo(origin.y + around.ymax))};
  if (columns.first == columns.last && rows.first == rows.last) return pixels_.at(rows.first, columns.first);
  rows_.begin(offset, (around.ymax - around.ymin) / y.size, columns, rows);
  return {};
}

PolygonMass PolygonScale::weigh() {
  PixelIntegrals sum;
  rows_.integrate([&](std::int64_t row, std::int64_t column, const PixelIntegrals& pixel) {
    const double value = pixels_.at(row, column);
    sum.area += value * pixel.area;
    sum.x += value * pixel.x;
    sum.y += value * pixel.y;
    sum.xx += value * pixel.xx;
    sum.yy += value * pixel.yy;
  });
  if (!(sum.area > 0)) return {};
  const double width = pixels_.x.size, height = pixels_.y.size;
  const double across = (sum.xx - sum.x * (sum.x / sum.area)) * width * width;
  const double along = (sum.yy - sum.y * (sum.y / sum.area)) * height * height;
  return {sum.area * width * height,
          {around_.xmin + sum.x / sum.area * width, around_.ymin + sum.y / sum.area * height},
          std::max(0.0, across + along) * width * height};
}

}  // namespace vorpipe::core
