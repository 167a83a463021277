#include "picture/color_ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vorpipe::core {
namespace {

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
  const auto powers = among(std::span(halves).first(1), every);
  if (powers.size() >= powers_enough) return powers;
  const auto mixed = among(halves, 1);
  return mixed.size() >= 2 ? mixed : roundNumbers(low, high, whole);
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
    const auto equal = std::ranges::equal_range(ranked, tick.second);
    const auto first = equal.begin() - ranked.begin(), last = equal.end() - ranked.begin() - 1;
    if (first <= last) {
      joined.back().first = static_cast<double>(first + last) / 2 / static_cast<double>(ranked.size() - 1);
    }
  }
  ticks = std::move(joined);
}

}  // namespace

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

}  // namespace vorpipe::core
