// Places of vertices, beside integers.
#include "space/place.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "space/predicates.h"
#include "support/sites/random_sites.h"

namespace vorpipe::space {
namespace {

using test::Random;
/// So many digits that none is lost in what these tests compute.
using Long = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<1000, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;
using Long3 = std::array<Long, 3>;

struct LongRow {
  Long3 d;
  Long lift;
};

LongRow seen(const Places& places, Label from, Label other) {
  const Point3& p = places.sites[from];
  if (isWallLabel(other)) {
    const int axis = axisOf(wallOf(other)), out = isUpper(wallOf(other)) ? 1 : -1;
    LongRow row;
    row.d[static_cast<std::size_t>(axis)] = out;
    row.lift = 2 * out * (Long(places.offset(wallOf(other))) - coordinate(p, axis));
    return row;
  }
  const Point3& q = places.sites[other];
  const Long x = Long(q.x) - p.x, y = Long(q.y) - p.y, z = Long(q.z) - p.z;
  Long lighter = 0;
  if (places.weights != nullptr) lighter = Long(places.weights[from]) - places.weights[other];
  return {{x, y, z}, x * x + y * y + z * z + lighter};
}

Long3 longPlace(const Places& places, const std::array<Label, 4>& label) {
  const auto a = seen(places, label[0], label[1]), b = seen(places, label[0], label[2]),
             c = seen(places, label[0], label[3]);
  const auto cross = [](const Long3& p, const Long3& q) {
    return Long3{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  };
  const auto bc = cross(b.d, c.d), ca = cross(c.d, a.d), ab = cross(a.d, b.d);
  const Long twice = 2 * (a.d[0] * bc[0] + a.d[1] * bc[1] + a.d[2] * bc[2]);
  Long3 p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = (a.lift * bc[k] + b.lift * ca[k] + c.lift * ab[k]) / twice;
  return p;
}

double distance(const Long3& p, const Point3& q) {
  const Long x = p[0] - q.x, y = p[1] - q.y, z = p[2] - q.z;
  return static_cast<double>(sqrt(x * x + y * y + z * z));
}

double length(const Long3& p) { return distance(p, {0, 0, 0}); }

/// Four labels around a point, flat by 2^-flat; up to two are walls.
struct Four {
  std::array<Point3, 4> site{};
  Box3 box{0, 0, 0, 1, 1, 1};
  std::array<Label, 4> label{0, 1, 2, 3};
  std::array<double, 4> weight{};
  bool weighs = false;

  Four(Random& random, int flat, int small) {
    const double tilt = random.uniform();
    const Point3 about{random.uniform(), random.uniform(), random.uniform()};
    for (auto& p : site) {
      const double x = random.normal(), y = random.normal(), z = std::ldexp(random.normal(), -flat);
      const auto scaled = [&](double at) { return std::ldexp(0.1 * at, -small); };
      p = {about.x + scaled(x), about.y + scaled(y), about.z + scaled(z + tilt * x - y)};
    }
    const auto count = random.below(3);
    for (std::size_t k = 0; k < count; ++k) {
      const Label wall = labelOfWall(static_cast<int>(random.below(walls)));
      if (wall != label[1]) label[k + 1] = wall;
    }
  }
  /// Of all sizes, or so that the vertex is very near to a site though others are far.
  void weigh(Random& random) {
    weighs = true;
    const std::size_t near = random.below(4);
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = site[k].x - site[near].x, y = site[k].y - site[near].y, z = site[k].z - site[near].z;
      weight[k] = near % 2 == 0 ? std::pow(10.0, 6 * random.uniform() - 6)
                                : (x * x + y * y + z * z) * (1 + 1e-9 * random.uniform());
    }
  }
  [[nodiscard]] Places places() const { return {site.data(), box, weighs ? weight.data() : nullptr}; }
  [[nodiscard]] bool hasVertex() const {
    return orientation(places(), label[0], label[1], label[2], label[3]) != 0;
  }
};

void expectAsNearAsItSays(bool weighs) {
  Random random(1);
  int of_doubles = 0, of_pairs = 0, of_integers = 0;
  for (int trial = 0; trial < 1800; ++trial) {
    Four four(random, trial % 60, trial % 7 == 0 ? 40 : 0);
    if (!four.hasVertex()) continue;
    if (weighs) four.weigh(random);
    const auto& l = four.label;
    const Places places = four.places();
    const PlaceInDouble quick(relative(places, l[0], l[1]), relative(places, l[0], l[2]),
                              relative(places, l[0], l[3]));
    const auto exact = longPlace(places, l);
    if (quick.error < HUGE_VAL) {
      EXPECT_LE(distance(exact, quick.place), quick.error);
    }
    double error = 0;
    const Point3 p = vertexPlace(places, l[0], l[1], l[2], l[3], &error);
    ++(quick.condition < 1e3 ? of_doubles : quick.condition < 0x1p40 ? of_pairs : of_integers);
    EXPECT_LE(distance(exact, p), error);
    if (weighs && quick.condition < 1e3) continue;
    EXPECT_LE(error, (quick.condition < 1e3 ? 1e-11 : 1e-15) * length(exact));
  }
  EXPECT_GT(of_doubles, 100);
  EXPECT_GT(of_pairs, 300);
  EXPECT_GT(of_integers, 100);
}

TEST(Place, IsAsNearAsItSays) { expectAsNearAsItSays(false); }
TEST(Place, IsAsNearAsItSaysWithWeights) { expectAsNearAsItSays(true); }

/// Farther from each other than integers of 62 bits say, and so near that products underflow in double.
TEST(Place, IsRightForNumbersOfAnySize) {
  const std::array<Point3, 4> site{
      {{0x1p-170, 0, 0}, {0, 0x1p-172, 0}, {0, 0, 0x1p-169}, {0x1p-170, 0x1p-171, 3}}};
  const Places places{site.data(), {-0x1p190, -1, -1, 1, 1, 1}};
  for (const auto& label : {std::array<Label, 4>{0, 1, 2, 3}, {3, 0, 1, 2}, {1, 2, 0, -1}}) {
    const auto exact = longPlace(places, label);
    double error = 0;
    const Point3 p = vertexPlace(places, label[0], label[1], label[2], label[3], &error);
    EXPECT_LE(distance(exact, p), error);
    EXPECT_LE(error, 1e-15 * length(exact));
  }
}

TEST(Place, IsTheSameForAllWhoAsk) {
  Random random(2);
  for (int trial = 0; trial < 900; ++trial) {
    Four four(random, trial % 60, 0);
    if (!four.hasVertex()) continue;
    if (trial % 2 != 0) four.weigh(random);
    auto label = four.label;
    const Places places = four.places();
    const Point3 first = canonicalPlace(places, label);
    std::ranges::sort(label);
    do {
      EXPECT_EQ(canonicalPlace(places, label), first);
    } while (std::ranges::next_permutation(label).found);
    // Nor do sites' numbers count.
    auto other = four;
    std::swap(other.site[0], other.site[3]);
    std::swap(other.weight[0], other.weight[3]);
    for (Label& l : other.label) l = l == 0 ? 3 : l == 3 ? 0 : l;
    EXPECT_EQ(canonicalPlace(other.places(), other.label), first);
    for (const Label wall : label) {
      if (isWallLabel(wall)) {
        EXPECT_EQ(coordinate(first, axisOf(wallOf(wall))), places.offset(wallOf(wall)));
      }
    }
    const auto exact = longPlace(places, four.label);
    const Point3& from = four.site[0];
    const Long3 absolute{exact[0] + from.x, exact[1] + from.y, exact[2] + from.z};
    EXPECT_LE(distance(absolute, first), 1e-15 + 2e-11 * length(exact) + (four.weighs ? 2e-11 : 0));
  }
}

}  // namespace
}  // namespace vorpipe::space
