/// How values of sites become places along the colors.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// What colors stand for, as RenderOptions have it.
struct Coloring {
  ColorBy color;  ///< not by site
  ColorScale scale;
  std::optional<ColorRange> range;
};

/// The places along the colors, from 0 to 1, of values. Values that differ by rounding alone, 1e-7 of
/// their size, are one.
class ColorPlaces {
 public:
  /// `values` are those of the sites that have a cell, finite, in any order. Where a range is named,
  /// quantiles are those of the values inside it. Errors (input): the range is none, or holds nothing for the
  /// scale.
  static Result<ColorPlaces> of(const Coloring& coloring, std::vector<double> values, int threads = 0);

  /// Never falls where `value` rises: values below the range have 0, those above it 1, and the middle is that
  /// of all values where they are equal.
  [[nodiscard]] double operator()(double value) const;
  /// The same as the number of a color, rounded.
  [[nodiscard]] std::uint8_t colorOf(double value) const;
  [[nodiscard]] const ColorKey& key() const { return key_; }

 private:
  void joinRanked();
  [[nodiscard]] double rankOf(double value) const;
  void findFirsts();

  ColorKey key_;
  /// The values inside the range, ascending, of those that are one the least; by quantile alone.
  std::vector<double> ranked_;
  /// By color from the second on: the least of the ranked values that has it or a later one. A search among
  /// all that are ranked would be a cache miss for each step.
  std::vector<double> firsts_;
};

}  // namespace vorpipe::core
