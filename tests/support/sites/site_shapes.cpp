#include "support/sites/site_shapes.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace vorpipe::test {
namespace {

using std::numbers::pi;

}  // namespace

Sites crowded(std::uint64_t n, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double side = random.below(100) == 0 ? 1.0 : 0.1;
    const double low = side == 1.0 ? 0.0 : 0.37;
    add(sites, {low + side * random.uniform(), low + side * random.uniform()});
  }
  return sites;
}

Sites tightClusters(std::uint64_t n, Random& random) {
  const auto centers = generate(Pattern::random, 100, random());
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto c = random.below(100);
    add(sites, {0.01 + 0.98 * centers.x[c] + 1e-4 * random.normal(),
                0.01 + 0.98 * centers.y[c] + 1e-4 * random.normal()});
  }
  return sites;
}

Sites dust(std::uint64_t n, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    const bool spread = i % 2 == 0;
    const double x = random.uniform();
    const double y = random.uniform();
    add(sites, {spread ? x : 0.3 + 1e-9 * x, spread ? y : 0.6 + 1e-9 * y});
  }
  return sites;
}

Sites pairs(std::uint64_t n, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n / 2; ++i) {
    const double x = random.uniform();
    const double y = random.uniform();
    const double angle = 2 * pi * random.uniform();
    add(sites, {x, y});
    add(sites, {x + 1e-12 * std::cos(angle), y + 1e-12 * std::sin(angle)});
  }
  return sites;
}

Sites nearlyCollinear(std::uint64_t n, double noise, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double x = random.uniform();
    add(sites, {x, 0.1 + 0.75 * x + noise * random.uniform()});
  }
  return sites;
}

Sites collinear(std::uint64_t n, int step_x, int step_y, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto along = static_cast<double>(random.below(1 << 18));
    add(sites, {(0x20000 + along * step_x) * 0x1p-20, (0x30000 + along * step_y) * 0x1p-20});
  }
  return sites;
}

Sites curves(std::uint64_t n, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double t = random.uniform();
    switch (i % 6) {
      case 0:
        add(sites, {0.5 + 0.4 * std::cos(2 * pi * t), 0.5 + 0.4 * std::sin(2 * pi * t)});
        break;
      case 1:
        add(sites, {0.3 + 0.2 * std::cos(pi * t), 0.4 + 0.2 * std::sin(pi * t)});
        break;
      case 2:
        add(sites, {t, 0.5 + 0.3 * std::sin(6 * pi * t)});
        break;
      case 3:
        add(sites, {t, 0.1 + 0.8 * t * t});
        break;
      case 4:
        add(sites, {t, 0.95 - 0.9 * t});
        break;
      default:
        add(sites, {0.7 + 0.1 * std::cos(2 * pi * t), 0.3 + 0.1 * std::sin(2 * pi * t)});
    }
  }
  return sites;
}

Sites spiral(std::uint64_t n) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double t = std::sqrt((static_cast<double>(i) + 0.5) / static_cast<double>(n));
    add(sites, {0.5 + 0.45 * t * std::cos(40 * pi * t), 0.5 + 0.45 * t * std::sin(40 * pi * t)});
  }
  return sites;
}

Sites sunflower(std::uint64_t n) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double angle = pi * (3 - std::sqrt(5.0)) * static_cast<double>(i);
    const double radius = 0.48 * std::sqrt((static_cast<double>(i) + 0.5) / static_cast<double>(n));
    add(sites, {0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle)});
  }
  return sites;
}

Sites pythagorean(std::uint64_t n, std::int64_t multiple) {
  std::int64_t radius = 1;
  std::uint64_t points = 4;
  for (const std::int64_t prime : {5, 13, 17, 29, 37}) {
    if (points * 3 > n) break;
    radius *= prime;
    points *= 3;
  }
  Sites sites;
  for (std::int64_t x = -radius; x <= radius; ++x) {
    const auto squared = radius * radius - x * x;
    const auto y = static_cast<std::int64_t>(std::llround(std::sqrt(static_cast<double>(squared))));
    if (y * y != squared) continue;
    add(sites, {static_cast<double>(multiple * x), static_cast<double>(multiple * y)});
    if (y != 0) add(sites, {static_cast<double>(multiple * x), static_cast<double>(-multiple * y)});
  }
  return sites;
}

Sites concentric(std::uint64_t n) {
  Sites sites;
  for (const std::int64_t multiple : {2, 3, 5, 6}) append(sites, pythagorean(n / 4, multiple));
  return sites;
}

Sites stripes(std::uint64_t n, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    if (i % 10 == 0) {
      add(sites, {0.5 + 1e-12 * static_cast<double>(i / 10), 0.5});
    } else {
      add(sites, {random.uniform(), random.uniform()});
    }
  }
  return sites;
}

Sites onWalls(std::uint64_t n, Random& random) {
  Sites sites = {{0, 1, 0, 1}, {0, 0, 1, 1}, {}};
  for (std::uint64_t i = 4; i < n; ++i) {
    const double even = static_cast<double>(1 + random.below(63)) / 64;
    const double t = i % 2 == 0 ? even : random.uniform();
    switch (random.below(6)) {
      case 0:
        add(sites, {0, t});
        break;
      case 1:
        add(sites, {1, t});
        break;
      case 2:
        add(sites, {t, 0});
        break;
      case 3:
        add(sites, {t, 1});
        break;
      default:
        add(sites, {t, random.uniform()});
    }
  }
  return sites;
}

Sites mirrored(std::uint64_t n, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n / 4; ++i) {
    const double x = random.uniform();
    const double y = random.uniform();
    for (const double px : {x, 1 - x}) {
      for (const double py : {y, 1 - y}) add(sites, {px, py});
    }
  }
  return sites;
}

Sites mirroredAtWalls(std::uint64_t n, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n / 3; ++i) {
    const double x = random.uniform();
    const double y = random.uniform();
    add(sites, {x, y});
    add(sites, {i % 2 == 0 ? -x : 2 - x, y});
    add(sites, {x, i % 2 == 0 ? 2 - y : -y});
  }
  return sites;
}

Sites shuffled(Sites sites, Random& random) {
  for (std::size_t i = sites.size(); i > 1; --i) {
    const auto j = random.below(i);
    std::swap(sites.x[i - 1], sites.x[j]);
    std::swap(sites.y[i - 1], sites.y[j]);
  }
  return sites;
}

}  // namespace vorpipe::test
