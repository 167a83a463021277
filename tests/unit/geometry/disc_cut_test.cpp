#include "geometry/disc_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "vorpipe.h"

namespace vorpipe::test {
namespace {

using core::Arc;
using core::DiscCut;
using core::DiscShape;
using core::EdgeLine;

constexpr double pi = std::numbers::pi;
using Polygon = std::vector<Point>;

struct Measured {
  DiscShape shape;
  double area, spread, arc;
  Point centroid;
  std::vector<double> chords;
};

/// What the disc about the origin has of a polygon.
Measured cut(const Polygon& corners, double squared_radius) {
  DiscCut cut;
  DiscShape shape;
  Point origin{0, 0};
  if (DiscCut::isFar(corners, squared_radius)) {
    origin = corners[0];
    Polygon moved = corners;
    for (Point& p : moved) p = {p.x - origin.x, p.y - origin.y};
    shape = cut.cutFar(moved, {-origin.x, -origin.y}, squared_radius);
  } else {
    std::vector<EdgeLine> lines;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      lines.push_back(core::lineThrough(corners[k], corners[(k + 1) % corners.size()]));
    }
    shape = cut.cut(corners, lines, squared_radius);
  }
  Measured m{shape, 0, 0, 0, {0, 0}, {}};
  if (shape != DiscShape::part) return m;
  m = {shape,
       cut.area(),
       cut.spread(),
       cut.arcAngle(),
       {origin.x + cut.centroid().x, origin.y + cut.centroid().y},
       {}};
  for (const auto& chord : cut.chords()) m.chords.push_back(chord.length);
  return m;
}

Polygon square(double xmin, double ymin, double side) {
  return {{xmin, ymin}, {xmin + side, ymin}, {xmin + side, ymin + side}, {xmin, ymin + side}};
}

/// Convex, as its corners lie on an ellipse.
Polygon randomPolygon(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(0, 2 * pi), part(0.1, 1.0), shift(-1.5, 1.5);
  std::vector<double> angles(3 + random() % 6);
  for (double& a : angles) a = angle(random);
  std::ranges::sort(angles);
  const double height = part(random);
  const Point middle{shift(random), shift(random)};
  Polygon corners;
  for (const double a : angles) {
    corners.push_back({middle.x + std::cos(a), middle.y + height * std::sin(a)});
  }
  return corners;
}

/// By Green's theorem, edge by edge: triangles with the center where an edge is inside, sectors where it is
/// not.
struct Sums {
  long double area = 0, x = 0, y = 0, polar = 0, angle = 0;
};

void addPiece(long double ax, long double ay, long double bx, long double by, long double w, Sums& sums) {
  const long double turn = ax * by - ay * bx, dot = ax * bx + ay * by;
  const long double mx = (ax + bx) / 2, my = (ay + by) / 2;
  if (mx * mx + my * my <= w) {
    sums.area += turn / 2;
    sums.x += turn / 6 * (ax + bx);
    sums.y += turn / 6 * (ay + by);
    sums.polar += turn / 12 * (ax * ax + ay * ay + bx * bx + by * by + dot);
    return;
  }
  const long double angle = std::atan2(turn, dot), cube = w * std::sqrt(w) / 3;
  const long double a = std::hypot(ax, ay), b = std::hypot(bx, by);
  sums.area += w * angle / 2;
  sums.x += cube * (by / b - ay / a);
  sums.y -= cube * (bx / b - ax / a);
  sums.polar += w * w * angle / 4;
  sums.angle += angle;
}

Sums sumsOf(const Polygon& corners, long double w) {
  Sums sums;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point a = corners[k], b = corners[(k + 1) % corners.size()];
    const long double ax = a.x, ay = a.y, dx = b.x - ax, dy = b.y - ay;
    const long double squared = dx * dx + dy * dy, along = ax * dx + ay * dy;
    const long double root = along * along - squared * (ax * ax + ay * ay - w);
    long double first = 0, last = 0;
    if (root > 0) {
      first = std::clamp((-along - std::sqrt(root)) / squared, 0.0L, 1.0L);
      last = std::clamp((std::sqrt(root) - along) / squared, 0.0L, 1.0L);
    }
    const long double ends[] = {0, first, last, 1};
    for (int e = 0; e < 3; ++e) {
      if (!(ends[e + 1] > ends[e])) continue;
      addPiece(ax + ends[e] * dx, ay + ends[e] * dy, ax + ends[e + 1] * dx, ay + ends[e + 1] * dy, w, sums);
    }
  }
  return sums;
}

TEST(DiscCut, RandomPolygonsAreThoseOfGreensTheorem) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.05, 3);
  int parts = 0, several = 0;
  for (int round = 0; round < 20000; ++round) {
    const Polygon corners = randomPolygon(random);
    const double r = radius(random), w = r * r;
    const Measured m = cut(corners, w);
    const Sums sums = sumsOf(corners, w);
    if (m.shape != DiscShape::part) {
      EXPECT_NEAR(static_cast<double>(sums.angle), 0, 1e-15) << round;
      if (m.shape == DiscShape::nothing) {
        EXPECT_NEAR(static_cast<double>(sums.area), 0, 1e-15) << round;
      }
      continue;
    }
    ++parts;
    several += std::ranges::count_if(m.chords, [](double length) { return length > 0; }) > 2 ? 1 : 0;
    const double scale = std::min(w, 4.0);
    const long double x = sums.x / sums.area, y = sums.y / sums.area;
    ASSERT_NEAR(m.area, static_cast<double>(sums.area), 4e-15 * scale) << round;
    EXPECT_NEAR(m.area * m.centroid.x, static_cast<double>(sums.x), 1e-14 * scale * r) << round;
    EXPECT_NEAR(m.area * m.centroid.y, static_cast<double>(sums.y), 1e-14 * scale * r) << round;
    EXPECT_NEAR(m.spread, static_cast<double>(sums.polar - sums.area * (x * x + y * y)), 1e-14 * scale * w)
        << round;
  }
  EXPECT_GT(parts, 8000);
  EXPECT_GT(several, 2000);
}

TEST(DiscCut, SmallAndLargeDiscsKeepTheirDigits) {
  for (int power = -6; power <= 0; ++power) {
    const double r = std::pow(10, power) / 2, w = r * r;
    const Measured whole = cut(square(-1, -1, 2), w), half = cut(square(0, -1, 2), w);
    EXPECT_DOUBLE_EQ(whole.area, pi * w);
    EXPECT_DOUBLE_EQ(whole.spread, pi * w * w / 2);
    EXPECT_DOUBLE_EQ(whole.arc, 2 * pi);
    EXPECT_NEAR(whole.centroid.x, 0, 1e-16 * r);
    EXPECT_DOUBLE_EQ(half.area, pi * w / 2);
    EXPECT_DOUBLE_EQ(half.centroid.x, 4 * r / (3 * pi));
    EXPECT_DOUBLE_EQ(half.chords[3], 2 * r);
    EXPECT_DOUBLE_EQ(cut(square(0, 0, 1), w).area, pi * w / 4);
    // Beyond the square's side, with the center outside.
    const double gap = 0.9 * r, angle = std::acos(gap / r);
    EXPECT_NEAR(cut(square(gap, -1, 2), w).area, w * (angle - std::sin(angle) * std::cos(angle)), 4e-16 * w);
  }
  for (int power = 1; power <= 6; ++power) {
    // The circle runs through the square's middle, where it is x = -y^2 / (R + sqrt(R^2 - y^2)).
    const double r = std::pow(10, power), w = r * r;
    const Measured m = cut(square(r - 1, -1, 2), w);
    const auto left = [&](double y) { return y * y / (r + std::sqrt(w - y * y)); };
    double lost = 0;  // by Simpson's rule
    constexpr int steps = 200;
    for (int k = 0; k < steps; ++k) {
      const double y = 2.0 * k / steps - 1, h = 2.0 / steps;
      lost += h / 6 * (left(y) + 4 * left(y + h / 2) + left(y + h));
    }
    EXPECT_NEAR(m.area, 2 - lost, 1e-9 * std::pow(r, -4) + 2e-15) << r;
    EXPECT_NEAR(m.arc, 2 * std::asin(1 / r), 1e-15 / r) << r;
    EXPECT_NEAR(m.chords[0], 1 - left(1), 1e-15) << r;
  }
}

TEST(DiscCut, TouchesAreNotMistakenForTurns) {
  const Polygon inscribed = square(-1, -1, 2);
  EXPECT_DOUBLE_EQ(cut(inscribed, 1).area, pi);
  EXPECT_NEAR(cut(inscribed, std::nextafter(1, 2)).area, pi, 1e-14);
  EXPECT_EQ(cut(inscribed, 2).shape, DiscShape::polygon);
  EXPECT_NEAR(cut(inscribed, std::nextafter(2, 0)).area, 4, 1e-14);
  EXPECT_EQ(cut(square(1, -1, 2), 1).shape, DiscShape::nothing);
  EXPECT_EQ(cut(square(3, 4, 1), 25).shape, DiscShape::nothing);
  EXPECT_EQ(cut(square(3, 4, 1), 0).shape, DiscShape::nothing);
  EXPECT_EQ(cut(square(-1, -1, 2), -1).shape, DiscShape::nothing);
  // A flat corner that barely leaves, or enters, the disc: nearly a whole turn, or nearly nothing, is free.
  for (const double out : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0, -1e-15, -1e-9}) {
    for (const double slope : {1e-3, 1e-6, 1e-9}) {
      const Polygon corners{
          {-5, -5}, {1 + out - 5 * slope, -5}, {1 + out, 0}, {1 + out - 5 * slope, 5}, {-5, 5}};
      const Sums sums = sumsOf(corners, 1);
      EXPECT_NEAR(cut(corners, 1).area, static_cast<double>(sums.area), 4e-15) << out << " " << slope;
    }
  }
  // Corners that coincide.
  EXPECT_DOUBLE_EQ(cut({{-1, -1}, {0.5, -1}, {0.5, -1}, {0.5, 1}, {-1, 1}, {-1, 1}}, 0.25).area, pi / 4);
}

TEST(DiscCut, SegmentsAreWhatTheyAre) {
  for (const double a : {1e-8, 1e-4, 1e-2}) {
    const auto m = core::measureSegment(2, a);
    EXPECT_NEAR(m.area / (4 * 2 * a * a * a / 3), 1 - a * a / 5, 2e-8 * a + 1e-15);
    EXPECT_NEAR(m.height / (2 * a * a / 5), 1, a * a + 1e-15);
    EXPECT_NEAR(m.along / (16 * 2 * std::pow(a, 5) / 15), 1, a * a + 1e-15);
    EXPECT_NEAR(m.across / (16 * 2 * std::pow(a, 7) / 175), 1, a * a + 1e-15);
  }
  const auto before = core::measureSegment(1, std::nextafter(1, 0)), after = core::measureSegment(1, 1);
  EXPECT_NEAR(before.area, after.area, 1e-15);
  EXPECT_NEAR(before.height, after.height, 2e-15);
  EXPECT_NEAR(before.along, after.along, 2e-15);
  EXPECT_NEAR(before.across, after.across, 2e-15);
  const auto half = core::measureSegment(1, pi / 2), whole = core::measureSegment(1, pi);
  EXPECT_DOUBLE_EQ(half.area, pi / 2);
  EXPECT_DOUBLE_EQ(half.height, 4 / (3 * pi));
  EXPECT_DOUBLE_EQ(whole.height, 1);
  EXPECT_DOUBLE_EQ(whole.along, pi / 4);
  EXPECT_DOUBLE_EQ(whole.across, pi / 4);
}

}  // namespace
}  // namespace vorpipe::test
