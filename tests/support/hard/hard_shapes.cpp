#include "support/hard/hard_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/sites/site_shapes.h"

namespace vorpipe::test {
namespace {

using std::numbers::pi;

Point anywhere(Random& random) {
  const double x = random.uniform();
  return {x, random.uniform()};
}

Sites even(std::uint64_t n, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) add(sites, anywhere(random));
  return sites;
}

/// Two to four sites side by side, 1e-15 to 1e-3 apart, all as far or each pair by itself.
Sites nearTwins(std::uint64_t n, Random& random) {
  Sites sites;
  const bool alike = onceIn(random, 2);
  const std::uint64_t together = 2 + random.below(3);
  double apart = tenTo(random, -15, -3);
  while (sites.size() < n) {
    const Point p = anywhere(random);
    add(sites, p);
    if (!alike) apart = tenTo(random, -15, -3);
    for (std::uint64_t k = 1; k < together; ++k) {
      const Point d = direction(random);
      add(sites, {p.x + apart * d.x, p.y + apart * d.y});
    }
  }
  return sites;
}

/// Some crowds, each 1e-13 to 1e-1 wide, and a few sites elsewhere.
Sites narrowCrowds(std::uint64_t n, Random& random) {
  Sites sites;
  const std::uint64_t crowds = 1 + random.below(4);
  for (std::uint64_t k = 0; k < crowds; ++k) {
    const Point c = anywhere(random);
    const double wide = tenTo(random, -13, -1);
    const bool stepped = onceIn(random, 3);
    for (std::uint64_t i = 0; i < std::max<std::uint64_t>(n / crowds, 2); ++i) {
      Point p = anywhere(random);
      if (stepped) p = {std::round(8 * p.x) / 8, std::round(8 * p.y) / 8};
      if (onceIn(random, 12)) {
        add(sites, anywhere(random));
      } else {
        add(sites, {c.x + wide * p.x, c.y + wide * p.y});
      }
    }
  }
  return sites;
}

/// One to three parallel rows, columns or diagonals, evenly spaced or not, with no jitter or some.
Sites jitteredRows(std::uint64_t n, Random& random) {
  Sites sites;
  const Point along = onceIn(random, 4) ? Point{1, 2} : direction(random);
  const std::uint64_t rows = 1 + random.below(3);
  const double jitter = onceIn(random, 3) ? 0 : tenTo(random, -17, -2);
  const double apart = oneOf(random, {0.25, 0.1, 1e-3, 1e-6, 1e-9});
  const bool evenly = onceIn(random, 2);
  const auto each = std::max<std::uint64_t>(n / rows, 1);
  for (std::uint64_t row = 0; row < rows; ++row) {
    for (std::uint64_t i = 0; i < each; ++i) {
      const double t = evenly ? (static_cast<double>(i) + 0.5) / static_cast<double>(each) : random.uniform();
      const double across = static_cast<double>(row) * apart + noise(random, jitter);
      add(sites,
          {0.5 + (t - 0.5) * along.x - across * along.y, 0.5 + (t - 0.5) * along.y + across * along.x});
    }
  }
  return sites;
}

/// All as far from one point, exactly, to the last bits, or nearly: their cells meet there. The point is
/// inside, on a wall or a corner of the domains that are made of quarters.
Sites aroundVertex(std::uint64_t n, Random& random) {
  if (onceIn(random, 6)) {
    auto sites = pythagorean(n, 1);
    const double size = 1 / (2.5 * *std::ranges::max_element(sites.x));
    for (double& x : sites.x) x = 0.5 + x * size;
    for (double& y : sites.y) y = 0.5 + y * size;
    return sites;
  }
  Sites sites;
  const Point center = onceIn(random, 3) ? anywhere(random)
                                         : Point{oneOf(random, {0.0, 0.25, 0.5, 0.75, 1.0}),
                                                 oneOf(random, {0.0, 0.25, 0.5, 0.75, 1.0})};
  const double radius = oneOf(random, {0.4, 0.25, 0.01, 1e-6});
  const double off = onceIn(random, 3) ? 0 : tenTo(random, -16, -4);
  const bool evenly = onceIn(random, 2);
  const double arc = onceIn(random, 4) ? tenTo(random, -6, 0) : 1;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double t = evenly ? static_cast<double>(i) / static_cast<double>(n) : random.uniform();
    const double away = radius * (1 + noise(random, off));
    add(sites, {center.x + away * std::cos(2 * pi * arc * t), center.y + away * std::sin(2 * pi * arc * t)});
  }
  if (onceIn(random, 3)) add(sites, center);
  return sites;
}

/// Powers of two or ten, and nothing, of either sign.
Sites powers(std::uint64_t n, Random& random) {
  Sites sites;
  const double base = oneOf(random, {2.0, 10.0});
  const std::uint64_t most = 1 + random.below(base == 2 ? 60 : 20);
  const auto coordinate = [&] {
    const double value = std::pow(base, -static_cast<double>(random.below(most)));
    return value * oneOf(random, {1.0, 1.0, -1.0, 0.0});
  };
  for (std::uint64_t i = 0; i < n; ++i) {
    const double x = coordinate();
    add(sites, {x, coordinate()});
  }
  return sites;
}

/// A square or hexagonal lattice, off by steps of the last place, or by about the length of a tie.
Sites shakenLattice(std::uint64_t n, Random& random) {
  auto sites = generate(oneOf(random, {Pattern::square, Pattern::square, Pattern::hex}),
                        std::max<std::uint64_t>(n, 4), 1);
  const bool ulps = onceIn(random, 2);
  const std::uint64_t steps = random.below(4);
  const double off = tenTo(random, -12, -4) / std::sqrt(static_cast<double>(n));
  for (auto* coordinates : {&sites.x, &sites.y}) {
    for (double& value : *coordinates) {
      if (ulps) {
        value = byUlps(
            value, static_cast<std::int64_t>(random.below(2 * steps + 1)) - static_cast<std::int64_t>(steps));
      } else {
        value += noise(random, off);
      }
    }
  }
  return sites;
}

/// On walls and corners of the unit square or its quarters, a hair beside them, and some inside.
Sites atWalls(std::uint64_t n, Random& random) {
  Sites sites;
  const auto wall = [&] {
    const double exact = oneOf(random, {0.0, 1.0, 0.25, 0.5, 0.75});
    switch (random.below(4)) {
      case 0:
        // The least double beside 0 now and then: two of these are too near to each other.
        return exact == 0 && !onceIn(random, 20) ? noise(random, 0x1p-53)
                                                 : byUlps(exact, oneOf<std::int64_t>(random, {-1, 1}));
      case 1:
        return exact + oneOf(random, {-1.0, 1.0}) * tenTo(random, -15, -3);
      default:
        return exact;
    }
  };
  for (std::uint64_t i = 0; i < n; ++i) {
    const double x = onceIn(random, 3) ? random.uniform() : wall();
    add(sites, {x, onceIn(random, 3) ? random.uniform() : wall()});
  }
  return sites;
}

/// Small integers, exact or off by about the length of a tie.
Sites nearIntegers(std::uint64_t n, Random& random) {
  Sites sites;
  const std::uint64_t side = 2 + random.below(4);
  const double off = tenTo(random, -13, -4);
  const std::uint64_t exact = 1 + random.below(4);
  const auto coordinate = [&] {
    const auto whole = static_cast<double>(random.below(side));
    return onceIn(random, exact) ? whole + off * random.uniform() : whole;
  };
  for (std::uint64_t i = 0; i < n; ++i) {
    const double x = coordinate();
    add(sites, {x, coordinate()});
  }
  return sites;
}

/// Pairs mirrored at lines that walls of domains lie on, exactly or nearly: their bisectors lie in walls.
Sites mirroredPairs(std::uint64_t n, Random& random) {
  Sites sites;
  const double off = onceIn(random, 2) ? 0 : tenTo(random, -16, -4);
  const double at_x = oneOf(random, {0.0, 0.25, 0.5, 1.0}), at_y = oneOf(random, {0.0, 0.25, 0.75, 1.0});
  while (sites.size() < n) {
    const Point p = anywhere(random);
    add(sites, p);
    const double d = noise(random, off);
    add(sites, onceIn(random, 2) ? Point{2 * at_x - p.x + d, p.y} : Point{p.x, 2 * at_y - p.y + d});
  }
  return sites;
}

/// Along a parabola or an arc: long, thin cells.
Sites alongCurve(std::uint64_t n, Random& random) {
  Sites sites;
  const double bend = oneOf(random, {1.0, 0.1, 1e-3, 1e-6, 1e-9});
  const double off = onceIn(random, 2) ? 0 : tenTo(random, -15, -4);
  for (std::uint64_t i = 0; i < n; ++i) {
    const double x = random.uniform();
    add(sites, {x, 0.3 + bend * x * x + noise(random, off)});
  }
  return sites;
}

/// Crosses of four sites, two of which meet along an edge of length 0 or of about the length of a tie.
Sites tieCrosses(std::uint64_t n, Random& random) {
  Sites sites;
  while (sites.size() < n) {
    const Point c = anywhere(random);
    const double arm = tenTo(random, -4, -1);
    const double part = 1e-6 * (1 + oneOf(random, {0.0, 1.0, -1.0, 0.5}) * tenTo(random, -12, 0));
    const double turn = onceIn(random, 2) ? 0 : random.uniform();
    for (int k = 0; k < 4; ++k) {
      const double away = k % 2 == 0 ? arm : arm * (1 + part);
      add(sites, {c.x + away * std::cos(pi / 2 * (k + turn)), c.y + away * std::sin(pi / 2 * (k + turn))});
    }
  }
  return sites;
}

/// Between two lines that meet at a sharp angle, or nearly parallel ones.
Sites wedge(std::uint64_t n, Random& random) {
  Sites sites;
  const double angle = tenTo(random, -9, 0);
  const bool graded = onceIn(random, 2);
  for (std::uint64_t i = 0; i < n; ++i) {
    const double x = graded ? std::pow(0.5, static_cast<double>(i % 40) / 2) : random.uniform();
    add(sites, {x, 0.5 + oneOf(random, {-1.0, 1.0}) * angle * x});
  }
  return sites;
}

/// Anywhere, but some a hair from an axis.
Sites byAxes(std::uint64_t n, Random& random) {
  Sites sites;
  const double least = onceIn(random, 2) ? -320 : -20;
  const auto hair = [&] { return oneOf(random, {1.0, -1.0}) * tenTo(random, least, -9); };
  for (std::uint64_t i = 0; i < n; ++i) {
    const Point p = anywhere(random);
    add(sites, {onceIn(random, 3) ? hair() : p.x, onceIn(random, 3) ? hair() : p.y});
  }
  return sites;
}

constexpr std::array<HardShape, 15> shapes{{{"even", even},
                                            {"twins", nearTwins},
                                            {"crowds", narrowCrowds},
                                            {"rows", jitteredRows},
                                            {"vertex", aroundVertex},
                                            {"vertex", aroundVertex},
                                            {"powers", powers},
                                            {"lattice", shakenLattice},
                                            {"walls", atWalls},
                                            {"integers", nearIntegers},
                                            {"mirrored", mirroredPairs},
                                            {"curve", alongCurve},
                                            {"crosses", tieCrosses},
                                            {"wedge", wedge},
                                            {"axes", byAxes}}};

}  // namespace

std::span<const HardShape> hardShapes() { return shapes; }

}  // namespace vorpipe::test
