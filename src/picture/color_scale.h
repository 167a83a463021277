/// Maps values of sites to places along the colors.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// The meaning of colors, as in RenderOptions.
struct Coloring {
  ColorBy color;  ///< by values in a range
  ColorScale scale;
  std::optional<ColorRange> range;
};

/// Maps values to places along the colors, from 0 to 1. Values that differ only by rounding, 1e-7 of their
/// size, count as one.
class ColorPlaces {
 public:
  /// `values` are those of the sites that have a cell, finite, in any order. If there is a range, quantiles
  /// are those of the values inside it. Errors (input): the range is invalid, or holds no values usable by
  /// the scale.
  static Result<ColorPlaces> of(const Coloring& coloring, std::vector<double> values, int threads = 0);

  /// Returns a nondecreasing function of `value`: 0 for values below the range, 1 for those above it, and the
  /// middle if all values are equal.
  [[nodiscard]] double operator()(double value) const;
  /// The same as a color index, rounded.
  [[nodiscard]] std::uint8_t colorOf(double value) const;
  [[nodiscard]] const ColorKey& key() const { return key_; }

 private:
  void joinRanked();
  [[nodiscard]] double rankOf(double value) const;
  void findFirsts();

  ColorKey key_;
  /// The values inside the range, ascending; of values that count as one, the least. By quantile only.
  std::vector<double> ranked_;
  /// By color from the second on: the least ranked value with that color or a later one. A search in all
  /// ranked values would miss the cache at each step.
  std::vector<double> firsts_;
};

}  // namespace vorpipe::core
