#include "picture/color_scale.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "base/try.h"

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
  const bool linear = coloring.color == ColorBy::neighbors || coloring.color == ColorBy::value;
  return linear ? ColorScale::linear : ColorScale::quantile;
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

/// Approximate number of steps of an axis, and the distance from an end within which numbers get no tick.
constexpr double steps_wanted = 5, crowded = 0.07;
constexpr int most_ticks = 8;

/// Returns the double nearest to mantissa 10^exponent: 3 10^-1 is 0.3.
double decimal(double mantissa, int exponent) {
  return exponent < 0 ? mantissa / std::pow(10, -exponent) : mantissa * std::pow(10, exponent);
}

/// Returns the multiples of 1, 2 or 5 times a power of ten between two numbers, about five.
std::vector<double> roundNumbers(double low, double high, bool whole) {
  const double wanted = (high - low) / steps_wanted;
  if (!std::isfinite(wanted) || !(wanted > 0)) return {};
  int exponent = static_cast<int>(std::floor(std::log10(wanted)));
  const double part = wanted / decimal(1, exponent);
  double mantissa = part <= 1 ? 1 : part <= 2 ? 2 : part <= 5 ? 5 : 10;
  if (whole && exponent < 0) {
    mantissa = 1;
    exponent = 0;
  }
  const double step = decimal(mantissa, exponent);
  std::vector<double> numbers;
  const double first = std::floor(low / step) + 1;
  for (int k = 0; k < most_ticks; ++k) {
    const double number = decimal((first + k) * mantissa, exponent);
    if (!(number < high)) break;
    // Far from 0 the next multiple may be the same double.
    if (number > low && (numbers.empty() || number > numbers.back())) numbers.push_back(number);
  }
  return numbers;
}

/// Returns powers of ten, or 1, 2 and 5 times these, or multiples of one number: the first kind with enough
/// numbers.
std::vector<double> roundNumbersOfLogarithm(double low, double high, bool whole) {
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::floor(std::log10(high)));
  const auto among = [&](std::span<const double> mantissas, int every) {
    std::vector<double> numbers;
    for (int exponent = first; exponent <= last; ++exponent) {
      if (exponent % every != 0) continue;
      for (const double mantissa : mantissas) {
        const double number = decimal(mantissa, exponent);
        if (number > low && number < high) numbers.push_back(number);
      }
    }
    return numbers;
  };
  constexpr std::array<double, 3> halves{1, 2, 5};
  constexpr int powers_enough = 3, powers_most = 6;
  const int every = std::max(1, (last - first + powers_most - 1) / powers_most);
  auto numbers = among(std::span(halves).first(1), every);
  if (numbers.size() < powers_enough) numbers = among(halves, 1);
  if (numbers.size() < 2) numbers = roundNumbers(low, high, whole);
  return numbers;
}

/// Returns the quantile `part` of the values; between two values, interpolates, or takes one of them if
/// values are integers.
double quantileOf(std::span<const double> ranked, double part, bool whole) {
  const double at = part * static_cast<double>(ranked.size() - 1);
  if (whole) return ranked[static_cast<std::size_t>(std::lround(at))];
  const auto below = static_cast<std::size_t>(at);
  const double rest = at - std::floor(at);
  const double low = ranked[below], high = ranked[std::min(below + 1, ranked.size() - 1)];
  return low * (1 - rest) + high * rest;
}

/// Merges ticks of equal value into one, at the middle of the ranks with this value.
void joinEqual(std::vector<std::pair<double, double>>& ticks, std::span<const double> ranked) {
  std::vector<std::pair<double, double>> joined;
  for (const auto& tick : ticks) {
    if (joined.empty() || joined.back().second != tick.second) {
      joined.push_back(tick);
      continue;
    }
    const auto first = std::ranges::lower_bound(ranked, tick.second) - ranked.begin(),
               last = std::ranges::upper_bound(ranked, tick.second) - ranked.begin() - 1;
    if (first <= last) {
      joined.back().first = static_cast<double>(first + last) / 2 / static_cast<double>(ranked.size() - 1);
    }
  }
  ticks = std::move(joined);
}

/// Returns the ticks of a key whose other members are set. `ranked`: the values, ascending, by quantile only.
/// By quantile, ticks are the values at 0, 25, 50, 75 and 100 %, each once. Otherwise they are both ends, and
/// round numbers between them that are not too near to an end. If all values are equal there is one tick, in
/// the middle. Ticks for numbers of neighbors are integers.
std::vector<std::pair<double, double>> ticksOf(const ColorKey& key, std::span<const double> ranked) {
  const auto [low, high] = key.range;
  if (!(low < high)) return {{0.5, low}};
  std::vector<std::pair<double, double>> ticks{{0, low}};
  const bool whole = key.color == ColorBy::neighbors;
  if (key.scale == ColorScale::quantile) {
    for (const double part : {0.25, 0.5, 0.75}) {
      ticks.emplace_back(part, std::clamp(quantileOf(ranked, part, whole), low, high));
    }
  } else {
    const bool log = key.scale == ColorScale::log;
    for (const double number :
         log ? roundNumbersOfLogarithm(low, high, whole) : roundNumbers(low, high, whole)) {
      const double place =
          log ? std::log(number / low) / std::log(high / low) : (number - low) / (high - low);
      if (place >= crowded && place <= 1 - crowded) ticks.emplace_back(place, number);
    }
  }
  ticks.emplace_back(1, high);
  joinEqual(ticks, ranked);
  return ticks;
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
