#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "vorpipe.h"
#include "vorpipe/patterns.h"

// Generates the same sites on every platform. Uses only operations that IEEE 754 defines to the last bit.
// Never adds a product to something, because a compiler may fuse the two; a quotient cannot be fused.

namespace vorpipe {
namespace {

/// The shape of a box: patterns are made in the unit square, which is then stretched over the box.
struct Shape {
  double aspect = 1;  ///< width over height
  /// Lengths in the square for one in the box, along each axis, over that for areas.
  [[nodiscard]] Point squeezed() const { return {std::sqrt(aspect), 1 / std::sqrt(aspect)}; }
};

/// Columns and rows of a lattice.
struct Lattice {
  std::uint64_t columns, rows;
};

/// The number of rows with the same spacing as this many columns, at least 1 and at most n.
std::uint64_t rowsFor(std::uint64_t columns, const Shape& shape, std::uint64_t n) {
  const double rows = std::round(static_cast<double>(columns) / shape.aspect);
  return static_cast<std::uint64_t>(std::clamp(rows, 1.0, static_cast<double>(n)));
}

using Random = std::mt19937_64;  // the standard defines its numbers; it does not define distributions

/// In [0, 1), a multiple of 2^-53.
double uniform(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Nearly normal, mean 0 and variance 1, within -6 and 6.
double normal(Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += uniform(random);
  return sum;
}

bool isInside(Point p) { return p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1; }

/// Calls draw() until its point lies strictly inside the unit square.
template <class Draw>
Point drawInside(Draw draw) {
  Point p = draw();
  while (!isInside(p)) p = draw();
  return p;
}

Point uniformPoint(Random& random) {
  return drawInside([&] {
    const double x = uniform(random);
    const double y = uniform(random);
    return Point{x, y};
  });
}

void add(Sites& sites, Point p) {
  sites.x.push_back(p.x);
  sites.y.push_back(p.y);
}

/// Largest integer whose square is at most n.
std::uint64_t floorRoot(std::uint64_t n) {
  auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(n)));
  while (root * root > n) --root;
  while ((root + 1) * (root + 1) <= n) ++root;
  return root;
}

void generateRandom(Sites& sites, std::uint64_t n, Random& random) {
  for (std::uint64_t i = 0; i < n; ++i) add(sites, uniformPoint(random));
}

/// The number of columns for n sites: `root` in a square, else about sqrt(n * aspect), 1 to n.
std::uint64_t columnsFor(std::uint64_t root, std::uint64_t n, const Shape& shape) {
  if (shape.aspect == 1) return root;
  const double columns = std::floor(std::sqrt(static_cast<double>(n) * shape.aspect));
  return static_cast<std::uint64_t>(std::clamp(columns, 1.0, static_cast<double>(n)));
}

void generateSquare(Sites& sites, std::uint64_t n, const Shape& shape) {
  const std::uint64_t columns = columnsFor(floorRoot(n), n, shape);
  const std::uint64_t rows = std::min(rowsFor(columns, shape, n), n / columns);
  for (std::uint64_t row = 0; row < rows; ++row) {
    for (std::uint64_t column = 0; column < columns; ++column) {
      add(sites, {(static_cast<double>(column) + 0.5) / static_cast<double>(columns),
                  (static_cast<double>(row) + 0.5) / static_cast<double>(rows)});
    }
  }
}

/// A whole number of columns fills the width; the rows, sqrt(3) / 2 of their distance apart, are
/// centered in the height. In a box that is too thin for such a lattice they are on a line.
void generateHex(Sites& sites, std::uint64_t n, const Shape& shape) {
  const double row_ratio = std::sqrt(3.0) / 2;
  const auto most = static_cast<double>(n);
  const double columns = std::clamp(std::round(std::sqrt(most * row_ratio * shape.aspect)), 1.0, most);
  const double rows = std::max(1.0, std::round(columns / row_ratio / shape.aspect));
  if (rows > most) return generateSquare(sites, n, shape);
  const double half_rows_per_unit = 2 * columns / row_ratio / shape.aspect;
  for (double row = 0; row < rows; ++row) {
    const double shift = std::fmod(row, 2.0) == 0 ? 0.25 : 0.75;
    const double y = 0.5 + (2 * row - (rows - 1)) / half_rows_per_unit;
    for (double column = 0; column < columns; ++column) add(sites, {(column + shift) / columns, y});
  }
}

/// The smallest lattice with at least n squares; those left empty are spread evenly.
void generateJitter(Sites& sites, std::uint64_t n, Random& random, const Shape& shape) {
  const std::uint64_t columns = columnsFor(floorRoot(n - 1) + 1, n, shape);
  const std::uint64_t rows = std::max(rowsFor(columns, shape, n), (n + columns - 1) / columns);
  const auto width = static_cast<double>(columns), height = static_cast<double>(rows);
  for (std::uint64_t i = 0; i < n; ++i) {
    const std::uint64_t square = i * (columns * rows) / n;
    const auto row = static_cast<double>(square / columns);
    const auto column = static_cast<double>(square % columns);
    add(sites, drawInside([&] {
          const double x = (column + uniform(random)) / width;
          const double y = (row + uniform(random)) / height;
          return Point{x, y};
        }));
  }
}

void generateClusters(Sites& sites, std::uint64_t n, Random& random, const Shape& shape) {
  // In a thin box clusters are flat: otherwise nothing of them would lie in it.
  constexpr double flattest = 1.0 / 8;
  const Point squeezed{std::max(shape.squeezed().x, flattest), std::max(shape.squeezed().y, flattest)};
  struct Cluster {
    Point center;
    double per_unit;  ///< 1 / standard deviation
  };
  constexpr std::size_t count = 100;
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < count; ++i) {
    const Point center = uniformPoint(random);
    const double u = uniform(random);
    const double deviation = 0.002 + u * u / 36;  // most clusters are tight, the widest is 0.03
    clusters.push_back({center, 1 / deviation});
  }
  for (std::uint64_t i = 0; i < n; ++i) {
    const Cluster& cluster = clusters[random() % count];
    add(sites, drawInside([&] {
          const double x = cluster.center.x + normal(random) / cluster.per_unit / squeezed.x;
          const double y = cluster.center.y + normal(random) / cluster.per_unit / squeezed.y;
          return Point{x, y};
        }));
  }
}

/// Cosine and sine of an angle in [0, pi / 4] by Taylor's series, as 1 - a/(1*2) (1 - a/(3*4) (1 - ...
Point direction(double angle) {
  const double square = angle * angle;
  double cosine = 1, sine = 1;
  for (double k = 18; k > 0; k -= 2) {
    cosine = 1 - square * cosine / (k * (k - 1));
    sine = 1 - square * sine / (k * (k + 1));
  }
  return {cosine, sine * angle};
}

void generateCircle(Sites& sites, std::uint64_t n, const Shape& shape) {
  const Point sides{std::max(1.0, shape.aspect), std::max(1.0, 1 / shape.aspect)};  // over the shorter one
  constexpr double eighth_turn = 0x1.921FB54442D18p-1;
  constexpr double per_unit = 2.5;  // 1 / radius
  for (std::uint64_t i = 0; i < n; ++i) {
    const std::uint64_t octant = 8 * i / n;
    const std::uint64_t rest = 8 * i % n;
    const bool mirrored = octant % 2 == 1;
    const auto part = static_cast<double>(mirrored ? n - rest : rest) / static_cast<double>(n);
    const Point unit = direction(part * eighth_turn);
    // Multiples of 2^-44, so that sites opposite each other are exact mirror images.
    const double along = std::round(unit.x / per_unit * 0x1p44) * 0x1p-44;
    const double across = std::round(unit.y / per_unit * 0x1p44) * 0x1p-44;
    const std::uint64_t quarter = (octant + 1) / 2 % 4;
    const double side = mirrored ? -across : across;
    const Point turned = quarter == 0   ? Point{along, side}
                         : quarter == 1 ? Point{-side, along}
                         : quarter == 2 ? Point{-along, -side}
                                        : Point{side, -along};
    add(sites, {0.5 + turned.x / sides.x, 0.5 + turned.y / sides.y});
  }
}

void fill(Pattern pattern, std::uint64_t n, Random& random, const Shape& shape, Sites& sites) {
  switch (pattern) {
    case Pattern::random:
      return generateRandom(sites, n, random);
    case Pattern::square:
      return generateSquare(sites, n, shape);
    case Pattern::hex:
      return generateHex(sites, n, shape);
    case Pattern::jitter:
      return generateJitter(sites, n, random, shape);
    case Pattern::clusters:
      return generateClusters(sites, n, random, shape);
    case Pattern::circle:
      return generateCircle(sites, n, shape);
  }
}

Sites generateShaped(Pattern pattern, std::uint64_t n, std::uint64_t seed, const Shape& shape) {
  Random random(seed);
  Sites sites;
  sites.x.reserve(n);
  sites.y.reserve(n);
  fill(pattern, n, random, shape, sites);
  return sites;
}

}  // namespace

Sites generate(Pattern pattern, std::uint64_t n, std::uint64_t seed) {
  return generateShaped(pattern, n, seed, {});
}

Sites generate(Pattern pattern, std::uint64_t n, std::uint64_t seed, const Box& box) {
  const double width = box.xmax - box.xmin, height = box.ymax - box.ymin;
  Sites sites = generateShaped(pattern, n, seed, {width / height});
  // Rounding may lead past the far ends.
  for (double& x : sites.x) x = std::min(box.xmin + x * width, box.xmax);
  for (double& y : sites.y) y = std::min(box.ymin + y * height, box.ymax);
  return sites;
}

}  // namespace vorpipe
