#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "vorpipe.h"

namespace vorpipe {
namespace {

/// The smallest square around the box, with the same center.
Box squareAround(const Box& box) {
  const double width = box.xmax - box.xmin, height = box.ymax - box.ymin;
  const double grown = (std::max(width, height) - std::min(width, height)) / 2;
  return width < height ? Box{box.xmin - grown, box.ymin, box.xmax + grown, box.ymax}
                        : Box{box.xmin, box.ymin - grown, box.xmax, box.ymax + grown};
}

/// The least and the largest of some numbers, by several comparisons side by side.
std::pair<double, double> rangeOf(std::span<const double> numbers) {
  constexpr std::size_t lanes = 8;
  std::array<double, lanes> least, most;
  least.fill(numbers.front());
  most.fill(numbers.front());
  std::size_t k = 0;
  for (; k + lanes <= numbers.size(); k += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double number = numbers[k + lane];
      least[lane] = number < least[lane] ? number : least[lane];
      most[lane] = number > most[lane] ? number : most[lane];
    }
  }
  for (; k < numbers.size(); ++k) {
    least[0] = std::min(least[0], numbers[k]);
    most[0] = std::max(most[0], numbers[k]);
  }
  return {std::ranges::min(least), std::ranges::max(most)};
}

}  // namespace

Box boxOf(std::span<const Point> points) {
  const auto [left, right] = std::ranges::minmax(points, {}, &Point::x);
  const auto [low, high] = std::ranges::minmax(points, {}, &Point::y);
  return {left.x, low.y, right.x, high.y};
}

Box domainOf(const Sites& sites) { return domainOf(sites, Margin{}); }

Box domainOf(const Sites& sites, const Margin& margin) {
  const auto [xmin, xmax] = rangeOf(sites.x);
  const auto [ymin, ymax] = rangeOf(sites.y);
  const double longer = std::max(xmax - xmin, ymax - ymin);
  double grown = margin.value;
  if (margin.relative) grown = longer > 0 ? margin.value * longer : 0.5;
  if (margin.value > 0) {
    // Far from the origin so little may be below a coordinate's resolution; a few thousand steps are not.
    const double largest = std::max({std::abs(xmin), std::abs(xmax), std::abs(ymin), std::abs(ymax)});
    const double step = largest - std::nextafter(largest, 0.0);
    grown = std::max(grown, 4096 * step);
  }
  return {xmin - grown, ymin - grown, xmax + grown, ymax + grown};
}

Sites spreadOver(const Box& box, Sites sites) {
  const Box square = squareAround(box);
  for (double& x : sites.x) x = square.xmin + x * (square.xmax - square.xmin);
  for (double& y : sites.y) y = square.ymin + y * (square.ymax - square.ymin);
  return sites;
}

Sites spreadOverGlobe(Sites sites) {
  constexpr double half_turn = 180, degree = std::numbers::pi / 180;
  for (double& x : sites.x) x = half_turn * (2 * x - 1);
  for (double& y : sites.y) y = std::asin(std::clamp(2 * y - 1, -1.0, 1.0)) / degree;
  return sites;
}

}  // namespace vorpipe
