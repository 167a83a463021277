/// Curves on logarithmic axes, as SVG.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vorpipe::bench {

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< x and y, all above 0
  bool theirs = false;                            ///< figures of another program: dashed
};

struct Plot {
  std::string title, x, y;  ///< the axes' names with their units
  std::vector<Curve> curves;
};

/// A drawing of all plots that have a point, two side by side, with `caption` below. A curve has one color
/// in all of them, by its name.
std::string svg(std::span<const Plot> plots, const std::string& caption);

}  // namespace vorpipe::bench
