/// Random choices of hard inputs.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <span>
#include <vector>

#include "support/sites/random_sites.h"

namespace vorpipe::test {

/// True once in `times`.
inline bool onceIn(Random& random, std::uint64_t times) { return random.below(times) == 0; }

inline double between(Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

/// A power of ten, its exponent even between two.
inline double tenTo(Random& random, double low, double high) {
  return std::pow(10.0, between(random, low, high));
}

template <class T>
T oneOf(Random& random, std::initializer_list<T> values) {
  return std::data(values)[random.below(values.size())];
}

/// A direction: along an axis, a diagonal or any.
inline Point direction(Random& random) {
  const double turn = onceIn(random, 2) ? static_cast<double>(random.below(8)) / 8 : random.uniform();
  // Of eighths of a turn, so that axes are exact.
  if (turn == 0 || turn == 0.5) return {turn == 0 ? 1.0 : -1.0, 0};
  if (turn == 0.25 || turn == 0.75) return {0, turn == 0.25 ? 1.0 : -1.0};
  return {std::cos(2 * std::numbers::pi * turn), std::sin(2 * std::numbers::pi * turn)};
}

/// Some steps of a double's last place up or down.
inline double byUlps(double value, std::int64_t steps) {
  const double toward = steps < 0 ? -INFINITY : INFINITY;
  for (; steps != 0; steps += steps < 0 ? 1 : -1) value = std::nextafter(value, toward);
  return value;
}

/// Between -most and most.
inline double noise(Random& random, double most) { return between(random, -most, most); }

}  // namespace vorpipe::test
