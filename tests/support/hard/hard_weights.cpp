#include "support/hard/hard_weights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vorpipe::test {
namespace {

template <class Weigh>
std::vector<double> each(const Sites& sites, const Weigh& weigh) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < sites.size(); ++i) weights.push_back(weigh(i));
  return weights;
}

double squaredDistance(const Sites& sites, std::size_t i, Point p) {
  const double dx = sites.x[i] - p.x, dy = sites.y[i] - p.y;
  return dx * dx + dy * dy;
}

/// |p - c|^2, exactly or nearly: all cells meet in c, or are hidden by a hair.
std::vector<double> lifted(const Sites& sites, double extent, Random& random) {
  const auto some = random.below(sites.size());
  const Point center = oneOf(random, {Point{0, 0}, Point{0, 0}, Point{0.5 * extent, 0.5 * extent},
                                      Point{sites.x[some], sites.y[some]}});
  const double off = onceIn(random, 3) ? 0 : tenTo(random, -17, -3) * extent * extent;
  return each(sites, [&](std::size_t i) { return squaredDistance(sites, i, center) + noise(random, off); });
}

/// |p|^2 of nearly all of a square of a distance: the diagram of the sites, drawn small around a point.
std::vector<double> flattened(const Sites& sites, double extent, Random& random) {
  const double left = tenTo(random, -15, -1);
  const auto some = random.below(sites.size());
  const Point center =
      onceIn(random, 2) ? Point{0.5 * extent, 0.5 * extent} : Point{sites.x[some], sites.y[some]};
  return each(sites, [&](std::size_t i) { return (1 - left) * squaredDistance(sites, i, center); });
}

/// Some of the sites lifted, the others of no weight.
std::vector<double> partlyLifted(const Sites& sites, double extent, Random& random) {
  auto weights = lifted(sites, extent, random);
  const std::uint64_t times = 2 + random.below(4);
  for (double& weight : weights) {
    if (onceIn(random, times)) weight = 0;
  }
  return weights;
}

/// Even, up to 1e-12 to 1e4 squares of the mean spacing.
std::vector<double> spread(const Sites& sites, double extent, Random& random) {
  const double most = tenTo(random, -12, 4) * extent * extent / static_cast<double>(sites.size());
  return each(sites, [&](std::size_t) { return most * random.uniform(); });
}

/// Equal but for the last places.
std::vector<double> allButEqual(const Sites& sites, double extent, Random& random) {
  const double weight = extent * extent * tenTo(random, -6, 3);
  return each(sites, [&](std::size_t) { return byUlps(weight, static_cast<std::int64_t>(random.below(5))); });
}

/// A few that are far heavier, or lighter, than all others.
std::vector<double> giants(const Sites& sites, double extent, Random& random) {
  const std::uint64_t times = 2 + random.below(30);
  const double heavy = oneOf(random, {1.0, -1.0}) * extent * extent * tenTo(random, -3, 8);
  return each(sites, [&](std::size_t) { return onceIn(random, times) ? heavy * random.uniform() : 0.0; });
}

/// Squares of the distance to another site, more or less: the bisector of the two runs through a site.
std::vector<double> onTheEdge(const Sites& sites, double, Random& random) {
  const double off = onceIn(random, 2) ? 0 : tenTo(random, -16, -4);
  return each(sites, [&](std::size_t i) {
    const auto other = (i + 1 + random.below(std::min<std::size_t>(sites.size(), 3))) % sites.size();
    const double squared = squaredDistance(sites, i, {sites.x[other], sites.y[other]});
    return oneOf(random, {0.0, 1.0, -1.0, 0.5}) * squared * (1 + noise(random, off));
  });
}

/// Small integers.
std::vector<double> integers(const Sites& sites, double, Random& random) {
  const std::uint64_t most = 2 + random.below(12);
  return each(sites, [&](std::size_t) { return static_cast<double>(random.below(most)); });
}

/// Of all magnitudes that doubles have, and none.
std::vector<double> magnitudes(const Sites& sites, double extent, Random& random) {
  const double least = oneOf(random, {-320.0, -130.0, -30.0});
  return each(sites, [&](std::size_t) {
    return oneOf(random, {0.0, 1.0, 1.0, -1.0}) * extent * extent * tenTo(random, least, 0);
  });
}

constexpr std::array<HardWeights, 11> hard_weights{{{"lifted", lifted},
                                                    {"lifted", lifted},
                                                    {"lifted", lifted},
                                                    {"flattened", flattened},
                                                    {"partly-lifted", partlyLifted},
                                                    {"spread", spread},
                                                    {"all-but-equal", allButEqual},
                                                    {"giants", giants},
                                                    {"on-the-edge", onTheEdge},
                                                    {"integers", integers},
                                                    {"magnitudes", magnitudes}}};

}  // namespace

std::span<const HardWeights> hardWeights() { return hard_weights; }

}  // namespace vorpipe::test
