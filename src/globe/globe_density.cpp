#include "globe/globe_density.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/refusal.h"
#include "domain/degrees.h"

namespace vorpipe::core {
namespace {

constexpr double box_rounding = 1e-9;  // degrees

bool goesAround(const Box& box) { return box.xmax - box.xmin >= whole_turn - box_rounding; }

/// Two pixels of a row or column, and where a place is between their centers.
struct Between {
  std::size_t first, second;
  double part;
};

/// `at` is in pixels from the side of the box.
Between betweenCenters(double at, int count, bool is_around) {
  const double from_center = at - 0.5, low = std::floor(from_center);
  const auto index = [&](double pixel) {
    if (is_around) return static_cast<std::size_t>(pixel < 0 ? pixel + count : pixel < count ? pixel : 0);
    return static_cast<std::size_t>(std::clamp(pixel, 0.0, static_cast<double>(count - 1)));
  };
  return {index(low), index(low + 1), from_center - low};
}

}  // namespace

Box boxOnGlobe(const Density& density) {
  return density.box.value_or(Box{-whole_turn / 2, -quarter_turn, whole_turn / 2, quarter_turn});
}

Result<void> checkOnGlobe(const Density& density) {
  const Box box = boxOnGlobe(density);
  const bool is_on_it = box.xmax - box.xmin <= whole_turn + box_rounding &&
                        box.ymin >= -quarter_turn - box_rounding && box.ymax <= quarter_turn + box_rounding;
  if (is_on_it) return {};
  return tl::unexpected(refusalOf(
      Subject::density, fmt::format("its place {},{},{},{} is not on the globe: longitudes of one turn at "
                                    "most, latitudes from -90 to 90",
                                    box.xmin, box.ymin, box.xmax, box.ymax)));
}

GlobeDensity::GlobeDensity(const Density& density)
    : density_(density),
      box_(boxOnGlobe(density)),
      pixel_((box_.ymax - box_.ymin) / density.height * degree),
      columns_per_degree_(density.width / (box_.xmax - box_.xmin)),
      rows_per_degree_(density.height / (box_.ymax - box_.ymin)),
      is_around_(goesAround(box_)) {}

double GlobeDensity::at(const Direction& place) const {
  const Point degrees = placeOf(place);
  // Degrees east of the box's west side, less than a turn.
  const double east = degrees.x - box_.xmin, from_west = east - whole_turn * std::floor(east / whole_turn);
  const double down = box_.ymax - degrees.y;
  const bool is_inside =
      down >= 0 && degrees.y >= box_.ymin && (is_around_ || from_west <= box_.xmax - box_.xmin);
  if (!is_inside) return 0;
  const auto width = static_cast<std::size_t>(density_.width);
  const auto [west, next, along] =
      betweenCenters(from_west * columns_per_degree_, density_.width, is_around_);
  const auto [upper, lower, part] = betweenCenters(down * rows_per_degree_, density_.height, false);
  const auto row = [&](std::size_t r) {
    const double* const values = density_.values.data() + r * width;
    return values[west] + along * (values[next] - values[west]);
  };
  const double above = row(upper);
  return above + part * (row(lower) - above);
}

}  // namespace vorpipe::core
