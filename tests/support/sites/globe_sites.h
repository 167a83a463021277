/// Sites on the globe that are hard: few, on circles, at poles and 180 degrees, in lattices, close to each
/// other.
#pragma once

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/hard/hard_random.h"
#include "vorpipe.h"

namespace vorpipe::test {

struct GlobeSet {
  std::string name;
  Sites sites;
  bool on_circle = false;  ///< all sites lie on one, or are too few for a triangle
};

/// The place of a vector in space.
inline void addVector(Sites& sites, double x, double y, double z) {
  constexpr double degree = std::numbers::pi / 180;
  add(sites, {std::atan2(y, x) / degree, std::atan2(z, std::hypot(x, y)) / degree});
}

inline Sites randomOnGlobe(std::size_t count, std::uint64_t seed) {
  return spreadOverGlobe(generate(Pattern::random, count, seed));
}

/// `count` places around a middle, at most some degrees off.
inline Sites around(double longitude, double latitude, double degrees, std::size_t count,
                    std::uint64_t seed) {
  Random random(seed);
  Sites sites;
  for (std::size_t k = 0; k < count; ++k) {
    add(sites, {longitude + noise(random, degrees) / std::cos(latitude * std::numbers::pi / 180),
                latitude + noise(random, degrees)});
  }
  return sites;
}

/// A grid of longitudes and latitudes; with poles, hundreds of sites are at each.
inline Sites degreeGrid(double step, bool has_poles) {
  Sites sites;
  for (double y = has_poles ? -90 : -90 + step / 2; y <= 90; y += step) {
    for (double x = -180; x < 180; x += step) add(sites, {x, y});
  }
  return sites;
}

inline Sites joinedSites(Sites first, const Sites& second) {
  append(first, second);
  return first;
}

/// The vertices of a solid, and the middles of its edges, `times` over.
inline Sites icosahedral(int times) {
  using Vector = std::array<double, 3>;
  const double golden = std::numbers::phi;
  std::vector<Vector> corners;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      corners.push_back({0, a, b});
      corners.push_back({a, b, 0});
      corners.push_back({b, 0, a});
    }
  }
  const auto squared = [](const Vector& p, const Vector& q) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += (p[k] - q[k]) * (p[k] - q[k]);
    return sum;
  };
  Sites sites;
  for (const auto& [x, y, z] : corners) addVector(sites, x, y, z);
  // Points of the edges and faces: x p + y q + z r of corners that are neighbors.
  constexpr double edge = 4;
  for (std::size_t p = 0; p < corners.size(); ++p) {
    for (std::size_t q = p + 1; q < corners.size(); ++q) {
      if (squared(corners[p], corners[q]) > edge + 0.5) continue;
      for (int k = 1; k < times; ++k) {
        Vector at{};
        for (std::size_t c = 0; c < 3; ++c) at[c] = (times - k) * corners[p][c] + k * corners[q][c];
        addVector(sites, at[0], at[1], at[2]);
      }
      for (std::size_t r = q + 1; r < corners.size(); ++r) {
        if (squared(corners[p], corners[r]) > edge + 0.5 || squared(corners[q], corners[r]) > edge + 0.5)
          continue;
        for (int k = 1; k < times; ++k) {
          for (int l = 1; k + l < times; ++l) {
            Vector at{};
            for (std::size_t c = 0; c < 3; ++c)
              at[c] = (times - k - l) * corners[p][c] + k * corners[q][c] + l * corners[r][c];
            addVector(sites, at[0], at[1], at[2]);
          }
        }
      }
    }
  }
  return sites;
}

inline std::vector<GlobeSet> hardOnGlobe() {
  std::vector<GlobeSet> sets;
  const auto put = [&](const char* name, Sites sites, bool on_circle = false) {
    sets.push_back({name, std::move(sites), on_circle});
  };
  put("one", {{10}, {20}, {}}, true);
  put("two", {{10, 50}, {20, -30}, {}}, true);
  put("antipodes", {{10, -170}, {20, -20}, {}}, true);
  put("poles", {{33, 44}, {90, -90}, {}}, true);
  put("three", {{10, 50, 80}, {20, -30, 10}, {}}, true);
  Sites equator, parallel, meridian, hundreds;
  for (double x = -180; x < 180; x += 10) add(equator, {x, 0}), add(parallel, {x, 50});
  for (double y = -80; y <= 80; y += 10) add(meridian, {0, y}), add(meridian, {180, y});
  put("equator", equator, true);
  put("parallel", parallel, true);
  put("meridian", meridian, true);
  put("parallel and a pole", joinedSites(parallel, {{0}, {90}, {}}));
  put("octahedron", {{0, 90, 180, -90, 7, -7}, {0, 0, 0, 0, 90, -90}, {}});
  Sites cube;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) addVector(cube, x, y, z);
    }
  }
  put("cube", cube);
  put("icosahedron", icosahedral(1));
  put("icosahedral", icosahedral(6));
  put("grid with poles", degreeGrid(10, true));
  put("grid without poles", degreeGrid(10, false));
  put("turns", {{190, -170, 350, -10, -340, 20, 0, 120}, {10, 10, 20, 20, 30, -40, 80, -60}, {}});
  put("a pole twice", {{0, 100, 10, 130, -100}, {90, 90, 40, 30, -20}, {}});
  put("a hemisphere", around(10, 50, 25, 500, 3));
  put("at 180", around(180, -17, 3, 300, 4));
  put("a meter", joinedSites(randomOnGlobe(100, 5), around(20, 30, 1e-5, 300, 6)));
  put("a millimeter", joinedSites(randomOnGlobe(100, 7), around(20, 30, 1e-8, 100, 8)));
  put("at a pole", joinedSites(randomOnGlobe(20, 9), [] {
        Sites sites;
        Random random(10);
        for (int k = 0; k < 200; ++k) add(sites, {noise(random, 180), 90 - 1e-3 * random.uniform()});
        return sites;
      }()));
  put("random", randomOnGlobe(3000, 11));
  return sets;
}

/// Sites on a circle of any axis, `height` of whose plane is its distance from the middle of the sphere.
inline Sites onCircle(std::array<double, 3> axis, double height, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  for (double& part : axis) part /= length;
  // Two vectors at right angles to the axis and each other (Duff and others 2017).
  const double sign = std::copysign(1, axis[2]), a = -1 / (sign + axis[2]), b = axis[0] * axis[1] * a;
  const std::array right{1 + sign * axis[0] * axis[0] * a, sign * b, -sign * axis[0]};
  const std::array up{b, sign + axis[1] * axis[1] * a, -axis[1]};
  const double radius = std::sqrt(1 - height * height);
  Sites sites;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = noise(random, std::numbers::pi), x = radius * std::cos(angle),
                 y = radius * std::sin(angle);
    const auto at = [&](std::size_t c) { return height * axis[c] + x * right[c] + y * up[c]; };
    addVector(sites, at(0), at(1), at(2));
  }
  return sites;
}

/// Clusters of 64 sites that are 1e-6 to 1e-12 radians apart, alone and among others, and sites on circles,
/// alone and with others.
inline std::vector<GlobeSet> tightOnGlobe() {
  constexpr double degree = std::numbers::pi / 180;
  std::vector<GlobeSet> sets;
  std::uint64_t seed = 100;
  for (const double apart : {1e-6, 1e-8, 1e-10, 1e-11, 1e-12}) {
    for (const Point middle : {Point{0, 0}, Point{20, 30}, Point{180, 0}, Point{-133, -71}, Point{90, 45}}) {
      const double reach = 4 * apart / degree;
      const Sites cluster = around(middle.x, middle.y, reach, 64, ++seed);
      const std::string name = fmt::format("{} apart at {} {}", apart, middle.x, middle.y);
      sets.push_back({name, cluster});
      sets.push_back({name + " among others", joinedSites(cluster, randomOnGlobe(40, ++seed))});
      sets.push_back({name + " and another", joinedSites(cluster, around(-40, 12, reach, 64, ++seed))});
    }
  }
  for (const double height : {0.0, 0.3, -0.9, 0.999}) {
    for (const std::array axis :
         {std::array{0.0, 0.0, 1.0}, std::array{0.3, -0.5, 0.7}, std::array{1.0, 0.0, 0.0}}) {
      const Sites circle = onCircle(axis, height, 100, ++seed);
      const std::string name = fmt::format("circle {} around {} {} {}", height, axis[0], axis[1], axis[2]);
      sets.push_back({name, circle, true});
      sets.push_back({name + " and others", joinedSites(circle, randomOnGlobe(40, ++seed))});
    }
  }
  return sets;
}

inline CellsOptions ofGlobe(Detail detail = Detail::everything) {
  CellsOptions options{};
  options.globe = true;
  options.detail = detail;
  return options;
}

/// With weights between two, by a seed.
inline Sites capsOf(Sites sites, double low, double high, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(between(random, low, high));
  return sites;
}

}  // namespace vorpipe::test
