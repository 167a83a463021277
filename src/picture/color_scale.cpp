#include "picture/color_scale.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel_sort.h"
#include "base/try.h"
#include "picture/color_ticks.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t last_color = 255;

/// Relative difference of equal values due to rounding and to `transport`, which ends at 1e-8; it is
/// invisible.
constexpr double same_part = 1e-7;

/// Whether a value counts as equal to a smaller one.
bool isOne(double least, double value) {
  return value - least <= same_part * std::max(std::abs(least), std::abs(value));
}

std::uint8_t roundedColor(double place) {
  return static_cast<std::uint8_t>(std::lround(static_cast<double>(last_color) * place));
}

tl::unexpected<Error> refuseColors(std::string message) {
  return tl::unexpected(Error{ErrorCode::input, std::move(message)});
}

ColorScale scaleOf(const Coloring& coloring) {
  if (coloring.scale != ColorScale::automatic) return coloring.scale;
  return coloring.color == ColorBy::neighbors ? ColorScale::linear : ColorScale::quantile;
}

Result<void> checkRange(const ColorRange& range, ColorScale scale) {
  const bool ascends = std::isfinite(range.low) && std::isfinite(range.high) && range.low < range.high;
  if (!ascends) {
    return refuseColors(
        fmt::format("color range {} to {}: the first must be less than the second, and both finite",
                    range.low, range.high));
  }
  if (scale == ColorScale::log && range.low <= 0) {
    return refuseColors(
        fmt::format("color range {} to {}: the logarithm needs one above 0", range.low, range.high));
  }
  return {};
}

/// Returns the position of `at` between `low` and `high`, in halves, since the difference of large numbers is
/// infinite.
double fractionOf(double at, double low, double high) {
  const double whole = high / 2 - low / 2;
  if (!(whole > 0)) return at < low ? 0 : at > high ? 1 : 0.5;
  return std::clamp((at / 2 - low / 2) / whole, 0.0, 1.0);
}

}  // namespace

Result<ColorPlaces> ColorPlaces::of(const Coloring& coloring, std::vector<double> values, int threads) {
  ColorPlaces places;
  ColorKey& key = places.key_;
  key.color = coloring.color;
  key.scale = scaleOf(coloring);
  if (coloring.range) {
    VORPIPE_TRY(checkRange(*coloring.range, key.scale));
  }
  if (key.scale == ColorScale::log) std::erase_if(values, [](double value) { return value <= 0; });
  if (key.scale == ColorScale::quantile && coloring.range) {
    std::erase_if(
        values, [&range = *coloring.range](double value) { return value < range.low || value > range.high; });
  }
  const bool takes_range = coloring.range && key.scale != ColorScale::quantile;
  if (values.empty() && key.scale == ColorScale::log) {
    return refuseColors("color scale log: no value is above 0");
  }
  if (values.empty() && coloring.range && !takes_range) {
    return refuseColors(
        fmt::format("color range {} to {}: no value lies inside, and there is nothing to rank",
                    coloring.range->low, coloring.range->high));
  }
  if (takes_range) {
    key.range = *coloring.range;
  } else if (!values.empty()) {
    const auto [least, greatest] = std::ranges::minmax(values);
    key.range = {least, isOne(least, greatest) ? least : greatest};
  }
  if (key.scale == ColorScale::quantile) {
    parallelSort(values, threads);
    places.ranked_ = std::move(values);
    places.joinRanked();
    places.findFirsts();
  }
  key.ticks = ticksOf(key, places.ranked_);
  return places;
}

/// Replaces each value by the least one that it counts as equal to. Least values are not equal to each other,
/// so that a chain of values near each other does not merge into one.
void ColorPlaces::joinRanked() {
  double least = ranked_.empty() ? 0 : ranked_.front();
  for (double& value : ranked_) {
    if (!isOne(least, value)) least = value;
    value = least;
  }
  if (!ranked_.empty()) key_.range.high = ranked_.back();
}

double ColorPlaces::rankOf(double value) const {
  const auto after = std::ranges::upper_bound(ranked_, value);
  if (after != ranked_.begin() && isOne(*(after - 1), value)) value = *(after - 1);
  const auto [first, last] = std::equal_range(ranked_.begin(), ranked_.end(), value);
  if (first == last) return value < key_.range.low ? 0 : 1;
  const auto before = static_cast<double>(first - ranked_.begin());
  const auto equal = static_cast<double>(last - first);
  const auto most = static_cast<double>(ranked_.size() - 1);
  return most > 0 ? (before + (equal - 1) / 2) / most : 0.5;
}

void ColorPlaces::findFirsts() {
  firsts_.resize(last_color);
  for (std::size_t color = 1; color <= last_color; ++color) {
    const auto first = std::ranges::partition_point(
        ranked_, [&](double value) { return roundedColor(rankOf(value)) < color; });
    firsts_[color - 1] = first == ranked_.end() ? std::numeric_limits<double>::infinity() : *first;
  }
}

std::uint8_t ColorPlaces::colorOf(double value) const {
  if (key_.scale != ColorScale::quantile || value > key_.range.high) return roundedColor((*this)(value));
  return static_cast<std::uint8_t>(std::ranges::upper_bound(firsts_, value) - firsts_.begin());
}

double ColorPlaces::operator()(double value) const {
  const auto [low, high] = key_.range;
  if (key_.scale != ColorScale::quantile && value > high && isOne(high, value)) value = high;
  switch (key_.scale) {
    case ColorScale::quantile:
      return rankOf(value);
    case ColorScale::log:
      return value > 0 ? fractionOf(std::log(value), std::log(low), std::log(high)) : 0;
    default:
      return fractionOf(value, low, high);
  }
}

}  // namespace vorpipe::core
