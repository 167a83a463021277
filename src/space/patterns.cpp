#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "vorpipe.h"

// Generates the same sites on every platform: see generate.cpp of the plane. A quotient is never fused with
// the sum that it is added to.

namespace vorpipe {
namespace {

using RandomBits = std::mt19937_64;

/// In [0, 1), a multiple of 2^-53.
double unitDraw(RandomBits& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Nearly normal, mean 0 and variance 1, within -6 and 6.
double normalDraw(RandomBits& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += unitDraw(random);
  return sum;
}

bool inUnitCube(const Point3& p) { return p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1 && p.z > 0 && p.z < 1; }

/// Calls draw() until its point lies strictly inside the unit cube.
template <class Draw>
Point3 drawnInCube(const Draw& draw) {
  Point3 p = draw();
  while (!inUnitCube(p)) p = draw();
  return p;
}

Point3 anywhere(RandomBits& random) {
  return drawnInCube([&] {
    const double x = unitDraw(random), y = unitDraw(random), z = unitDraw(random);
    return Point3{x, y, z};
  });
}

/// The sides of a box that patterns are made for, relative to the root of its volume: their product is 1.
using Sides = std::array<double, 3>;

using Counts = std::array<std::uint64_t, 3>;

/// The number of cells of a side that has room for `cells` of them.
std::uint64_t wholeCells(double cells) {
  return static_cast<std::uint64_t>(std::clamp(std::round(cells), 1.0, 0x1p31));
}

/// Numbers of cells of a lattice along the axes, so that each is nearly a cube: about `cells` of them. Where
/// a side has no room for one, it has one that is flat.
Counts nearCubes(double cells, const Sides& sides) {
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::ranges::sort(axes, {}, [&](std::size_t axis) { return sides[axis]; });
  Counts counts{};
  double left = std::max(cells, 1.0), volume = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t axis = axes[k];
    const double per_unit = k == 0 ? std::cbrt(left) : k == 1 ? std::sqrt(left / volume) : left / volume;
    counts[axis] = wholeCells(per_unit * sides[axis]);
    left = std::max(1.0, left / static_cast<double>(counts[axis]));
    volume /= sides[axis];
  }
  return counts;
}

/// The same for a lattice, whose cells should be cubes: rather another number of them, up to a fifth along
/// each axis, than cells that are stretched.
Counts latticeCounts(double cells, const Sides& sides) {
  const double wanted = std::cbrt(std::max(cells, 1.0)) * std::ranges::min(sides);
  constexpr double fewest = 0.8, most = 1.25, cost_of_number = 0.05;
  Counts best = nearCubes(cells, sides);
  if (wanted < fewest) return best;
  double least = std::numeric_limits<double>::infinity();
  for (double count = std::max(1.0, std::floor(fewest * wanted)); count <= std::ceil(most * wanted);
       ++count) {
    Counts counts{};
    double cost = cost_of_number * std::abs(count / wanted - 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double fits = count * (sides[axis] / std::ranges::min(sides));
      counts[axis] = wholeCells(fits);
      cost += std::abs(static_cast<double>(counts[axis]) / fits - 1);
    }
    if (cost >= least) continue;
    least = cost;
    best = counts;
  }
  return best;
}

/// Calls take(x, y, z) for each cell of a lattice.
template <class Take>
void eachCell(const Counts& counts, const Take& take) {
  for (std::uint64_t z = 0; z < counts[2]; ++z) {
    for (std::uint64_t y = 0; y < counts[1]; ++y) {
      for (std::uint64_t x = 0; x < counts[0]; ++x) {
        take(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
      }
    }
  }
}

void fillLattice(std::span<const Point3> basis, std::uint64_t n, const Sides& sides, Sites3& sites) {
  const auto counts = latticeCounts(static_cast<double>(n) / static_cast<double>(basis.size()), sides);
  const auto nx = static_cast<double>(counts[0]), ny = static_cast<double>(counts[1]),
             nz = static_cast<double>(counts[2]);
  eachCell(counts, [&](double x, double y, double z) {
    for (const Point3& at : basis) sites.push_back({(x + at.x) / nx, (y + at.y) / ny, (z + at.z) / nz});
  });
}

// Sites of a lattice's cell; none lies on a wall.
constexpr std::array<Point3, 1> of_cubic = {{{0.5, 0.5, 0.5}}};
constexpr std::array<Point3, 2> of_bcc = {{{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}}};
constexpr std::array<Point3, 4> of_fcc = {
    {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}}};
constexpr std::array<Point3, 8> of_diamond = {{{0.125, 0.125, 0.125},
                                               {0.625, 0.625, 0.125},
                                               {0.625, 0.125, 0.625},
                                               {0.125, 0.625, 0.625},
                                               {0.375, 0.375, 0.375},
                                               {0.875, 0.875, 0.375},
                                               {0.875, 0.375, 0.875},
                                               {0.375, 0.875, 0.875}}};
constexpr std::array<Point3, 8> of_a15 = {{{0.125, 0.125, 0.125},
                                           {0.625, 0.625, 0.625},
                                           {0.375, 0.625, 0.125},
                                           {0.875, 0.625, 0.125},
                                           {0.125, 0.375, 0.625},
                                           {0.125, 0.875, 0.625},
                                           {0.625, 0.125, 0.375},
                                           {0.625, 0.125, 0.875}}};

/// A whole number of sites fills the width; rows and layers are centered in the other two sides. In a box
/// that is too thin for such a lattice, sites are as those of `cubic`.
void fillHcp(std::uint64_t n, const Sides& sides, Sites3& sites) {
  const auto most = static_cast<double>(n);
  const double row_ratio = std::sqrt(3.0) / 2, layer_ratio = std::sqrt(6.0) / 3;
  // A site has the volume d^3 / sqrt(2).
  const double per_side = std::cbrt(most / std::sqrt(2.0));
  if (per_side * std::ranges::min(sides) < 1) return fillLattice(of_cubic, n, sides, sites);
  const double columns = std::round(per_side * sides[0]);
  const double spacing = sides[0] / columns;
  const double rows_per_side = std::max(1.0, sides[1] / spacing / row_ratio),
               layers_per_side = std::max(1.0, sides[2] / spacing / layer_ratio);
  const double rows = std::floor(rows_per_side), layers = std::floor(layers_per_side);
  for (double layer = 0; layer < layers; ++layer) {
    const bool second = std::fmod(layer, 2.0) != 0;
    const double z = 0.5 + (2 * layer - (layers - 1)) / (2 * layers_per_side);
    for (double row = 0; row < rows; ++row) {
      // The second kind of layer stands a third of a row's distance beside the first.
      const double sixths = 6 * row - 3 * (rows - 1) + (second ? 1 : -1);
      const double y = 0.5 + sixths / (6 * rows_per_side);
      const bool shifted = (std::fmod(row, 2.0) != 0) != second;
      for (double column = 0; column < columns; ++column) {
        sites.push_back({(column + (shifted ? 0.75 : 0.25)) / columns, y, z});
      }
    }
  }
}

/// The smallest lattice with at least n cubes; those left empty are spread evenly.
void fillJitter(std::uint64_t n, const Sides& sides, RandomBits& random, Sites3& sites) {
  Counts counts = nearCubes(static_cast<double>(n), sides);
  while (counts[0] * counts[1] * counts[2] < n) {
    // One more layer where the cubes are largest.
    std::size_t widest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      if (sides[axis] / static_cast<double>(counts[axis]) >
          sides[widest] / static_cast<double>(counts[widest]))
        widest = axis;
    }
    ++counts[widest];
  }
  const std::uint64_t cubes = counts[0] * counts[1] * counts[2];
  const auto nx = static_cast<double>(counts[0]), ny = static_cast<double>(counts[1]),
             nz = static_cast<double>(counts[2]);
  // The i-th site has the cube i * cubes / n, by steps of whole numbers that stay below 2^64.
  const std::uint64_t whole = cubes / n, part = cubes % n;
  std::uint64_t cube = 0, over = 0;
  for (std::uint64_t i = 0; i < n; ++i) {
    const std::uint64_t row = cube / counts[0], layer = row / counts[1];
    const auto x = static_cast<double>(cube % counts[0]), y = static_cast<double>(row % counts[1]),
               z = static_cast<double>(layer);
    sites.push_back(drawnInCube([&] {
      const double dx = unitDraw(random), dy = unitDraw(random), dz = unitDraw(random);
      return Point3{(x + dx) / nx, (y + dy) / ny, (z + dz) / nz};
    }));
    cube += whole;
    over += part;
    if (over >= n) {
      over -= n;
      ++cube;
    }
  }
}

void fillClusters(std::uint64_t n, const Sides& sides, RandomBits& random, Sites3& sites) {
  // In a thin box clusters are flat: otherwise nothing of them would lie in it.
  constexpr double flattest = 1.0 / 8;
  struct Cluster {
    Point3 center;
    double per_unit;  ///< 1 / standard deviation
  };
  constexpr std::size_t count = 200;
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < count; ++i) {
    const Point3 center = anywhere(random);
    const double u = unitDraw(random);
    const double deviation = 0.004 + u * u / 20;
    clusters.push_back({center, 1 / deviation});
  }
  std::array<double, 3> squeezed{};
  for (std::size_t axis = 0; axis < 3; ++axis) squeezed[axis] = std::max(sides[axis], flattest);
  for (std::uint64_t i = 0; i < n; ++i) {
    if (random() % 10 == 0) {
      sites.push_back(anywhere(random));
      continue;
    }
    const Cluster& cluster = clusters[random() % count];
    sites.push_back(drawnInCube([&] {
      const double x = normalDraw(random), y = normalDraw(random), z = normalDraw(random);
      return Point3{cluster.center.x + x / cluster.per_unit / squeezed[0],
                    cluster.center.y + y / cluster.per_unit / squeezed[1],
                    cluster.center.z + z / cluster.per_unit / squeezed[2]};
    }));
  }
}

void fillSphere(std::uint64_t n, const Sides& sides, RandomBits& random, Sites3& sites) {
  constexpr double per_unit = 2.5;  // 1 / radius
  const double shortest = std::min({sides[0], sides[1], sides[2]});
  // Multiples of 2^-25, whose squares and their sum are exact.
  const auto draw = [&] { return static_cast<double>(random() >> 38) * 0x1p-25 - 1; };
  for (std::uint64_t i = 0; i < n;) {
    const double x = draw(), y = draw(), z = draw();
    const double squared = x * x + y * y + z * z;
    if (squared > 1 || squared < 0x1p-20) continue;
    const double reach = std::sqrt(squared) * per_unit / shortest;
    sites.push_back(
        {0.5 + x / (reach * sides[0]), 0.5 + y / (reach * sides[1]), 0.5 + z / (reach * sides[2])});
    ++i;
  }
}

/// In the unit cube, which is stretched over the box afterwards.
Sites3 patternOf(Pattern3 pattern, std::uint64_t n, std::uint64_t seed, const Sides& sides) {
  RandomBits random(seed);
  Sites3 sites;
  sites.reserve(n);
  switch (pattern) {
    case Pattern3::random:
      for (std::uint64_t i = 0; i < n; ++i) sites.push_back(anywhere(random));
      break;
    case Pattern3::jitter:
      fillJitter(n, sides, random, sites);
      break;
    case Pattern3::clusters:
      fillClusters(n, sides, random, sites);
      break;
    case Pattern3::sphere:
      fillSphere(n, sides, random, sites);
      break;
    case Pattern3::cubic:
      fillLattice(of_cubic, n, sides, sites);
      break;
    case Pattern3::bcc:
      fillLattice(of_bcc, n, sides, sites);
      break;
    case Pattern3::fcc:
      fillLattice(of_fcc, n, sides, sites);
      break;
    case Pattern3::diamond:
      fillLattice(of_diamond, n, sides, sites);
      break;
    case Pattern3::a15:
      fillLattice(of_a15, n, sides, sites);
      break;
    case Pattern3::hcp:
      fillHcp(n, sides, sites);
      break;
  }
  return sites;
}

}  // namespace

Sites3 generate(Pattern3 pattern, std::uint64_t n, std::uint64_t seed) {
  return patternOf(pattern, n, seed, {1, 1, 1});
}

Sites3 generate(Pattern3 pattern, std::uint64_t n, std::uint64_t seed, const Box3& box) {
  const double dx = box.xmax - box.xmin, dy = box.ymax - box.ymin, dz = box.zmax - box.zmin;
  const double side = std::cbrt(dx) * std::cbrt(dy) * std::cbrt(dz);
  Sites3 sites = dx == dy && dy == dz ? generate(pattern, n, seed)
                                      : patternOf(pattern, n, seed, {dx / side, dy / side, dz / side});
  // Rounding may lead past the far ends.
  for (Point3& p : sites) {
    p = {std::min(box.xmin + p.x * dx, box.xmax), std::min(box.ymin + p.y * dy, box.ymax),
         std::min(box.zmin + p.z * dz, box.zmax)};
  }
  return sites;
}

}  // namespace vorpipe
