// Signs about sites and walls, beside one determinant in integers that gives all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "space/predicates.h"
#include "support/sites/random_sites.h"

namespace vorpipe::space {
namespace {

using test::Random;
using Integer = boost::multiprecision::mpz_int;

/// A row of a determinant: of a site of weight w (x, y, z, |x|^2 - w, 1), of a wall (n, 2 h, 0).
using OracleRow = std::array<Integer, 5>;

Integer determinant(const std::vector<OracleRow>& rows, const std::vector<std::size_t>& columns) {
  if (columns.size() == 1) return rows.back()[columns[0]];
  const OracleRow& row = rows[rows.size() - columns.size()];
  Integer sum = 0;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (row[columns[k]] == 0) continue;
    auto rest = columns;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
    const Integer term = row[columns[k]] * determinant(rows, rest);
    sum += k % 2 == 0 ? term : Integer(-term);
  }
  return sum;
}

/// A site, three labels of a vertex and one more.
struct Tuple {
  std::vector<Point3> site;
  Box3 box{};
  std::array<Label, 5> label{};
  std::vector<double> weight{};  ///< none, or of each site

  [[nodiscard]] Places places() const { return {site.data(), box, weight.empty() ? nullptr : weight.data()}; }
  [[nodiscard]] int orientation() const {
    return space::orientation(places(), label[0], label[1], label[2], label[3]);
  }
  [[nodiscard]] bool cuts() const {
    return space::cuts(places(), label[0], label[1], label[2], label[3], label[4]);
  }
};

class Oracle {
 public:
  explicit Oracle(const Tuple& tuple) : tuple_(tuple) {
    int most = -5000;
    for (const double number : numbers()) {
      int exponent = 0;
      if (std::frexp(number, &exponent) == 0) continue;
      least_ = std::min(least_, exponent - 53);
      most = std::max(most, exponent);
    }
    for (const double weight : tuple.weight) {
      int exponent = 0;
      if (std::frexp(weight, &exponent) != 0) least_ = std::min(least_, (exponent - 53) / 2 - 1);
    }
    bits_ = most - least_;
    for (const Label label : tuple.label) rows_.push_back(row(label));
  }

  [[nodiscard]] int orientation() const {
    const std::vector<OracleRow> four(rows_.begin(), rows_.begin() + 4);
    return -determinant(four, {0, 1, 2, 4}).sign();
  }

  [[nodiscard]] bool isTie() const { return determinant(rows_, {0, 1, 2, 3, 4}) == 0; }

  /// Heights are lowered by 2^-step, 4^-step, ... of a unit. What these weigh are 3x3 minors of places and
  /// ones, of less than 2^step.
  [[nodiscard]] bool cuts() const {
    const Integer plain = determinant(rows_, {0, 1, 2, 3, 4});
    if (plain != 0) return plain.sign() * orientation() < 0;
    auto perturbed = rows_;
    std::vector<std::size_t> order{0, 1, 2, 3, 4};
    std::ranges::sort(order, [&](auto a, auto b) { return key(a) < key(b); });
    const auto step = static_cast<unsigned>(3 * bits_ + 8);
    for (std::size_t k = 0; k < 5; ++k) {
      auto& height = perturbed[order[k]][3];
      height = (height << (5 * step)) - (Integer(1) << (step * static_cast<unsigned>(4 - k)));
    }
    return determinant(perturbed, {0, 1, 2, 3, 4}).sign() * orientation() < 0;
  }

 private:
  [[nodiscard]] std::vector<double> numbers() const {
    const Box3& b = tuple_.box;
    std::vector<double> all{b.xmin, b.ymin, b.zmin, b.xmax, b.ymax, b.zmax};
    for (const auto& p : tuple_.site) all.insert(all.end(), {p.x, p.y, p.z});
    return all;
  }

  [[nodiscard]] Integer integer(double number) const { return integer(number, least_); }
  static Integer integer(double number, int least) {
    int exponent = 0;
    const double digits = std::frexp(number, &exponent);
    const Integer whole = static_cast<std::int64_t>(std::ldexp(digits, 53));
    return whole == 0 ? whole : Integer(whole << static_cast<unsigned>(exponent - 53 - least));
  }

  [[nodiscard]] OracleRow row(Label label) const {
    if (isWallLabel(label)) {
      const int wall = wallOf(label), out = isUpper(wall) ? 1 : -1;
      OracleRow wall_row{0, 0, 0, 2 * out * integer(tuple_.places().offset(wall)), 0};
      wall_row[static_cast<std::size_t>(axisOf(wall))] = out;
      return wall_row;
    }
    const Point3& p = tuple_.site[static_cast<std::size_t>(label)];
    const Integer x = integer(p.x), y = integer(p.y), z = integer(p.z);
    const Integer weight = tuple_.weight.empty()
                               ? Integer(0)
                               : integer(tuple_.weight[static_cast<std::size_t>(label)], 2 * least_);
    return {x, y, z, x * x + y * y + z * z - weight, 1};
  }

  /// By which heights are ordered.
  [[nodiscard]] std::tuple<int, Point3> key(std::size_t of) const {
    const Label label = tuple_.label[of];
    if (isWallLabel(label)) return {wallOf(label) - walls, Point3{}};
    return {0, tuple_.site[static_cast<std::size_t>(label)]};
  }

  Tuple tuple_;
  int least_ = 5000, bits_ = 0;
  std::vector<OracleRow> rows_;
};

/// Five places of one kind, in or about the unit cube.
using Family = Point3 (*)(Random&, const Point3& about, int digits);

double sign(Random& random) { return random.below(2) == 0 ? 1 : -1; }

Point3 anywhere(Random& random, const Point3&, int) {
  const double x = random.uniform(), y = random.uniform();
  return {x, y, random.uniform()};
}

Point3 snapped(Random& random, const Point3&, int digits) {
  const auto at = [&] { return std::ldexp(std::floor(std::ldexp(random.uniform(), digits)), -digits); };
  const double x = at(), y = at();
  return {x, y, at()};
}

Point3 latticePoint(Random& random, const Point3& about, int digits) {
  const double step = digits % 2 == 0 ? 0x1p-5 : 0.03;
  const auto at = [&](double from) {
    return (std::floor(20 * from) + static_cast<double>(random.below(digits < 16 ? 2 : 3))) * step;
  };
  const double x = at(about.x), y = at(about.y);
  return {x, y, at(about.z)};
}

/// Corners of a box, of so many digits that ties take integers of each width.
Point3 boxCorner(Random& random, const Point3& about, int digits) {
  const double x = sign(random) * about.x, y = sign(random) * std::ldexp(about.y, -digits);
  return {x, y, sign(random) * about.z};
}

Point3 decimal(Random& random, const Point3&, int digits) {
  const double scale = std::pow(10.0, 1 + digits % 6);
  const auto at = [&] { return std::floor(random.uniform() * scale) / scale; };
  const double x = at(), y = at();
  return {x, y, at()};
}

Point3 tupleOnSphere(Random& random, const Point3& about, int digits) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  const double radius = 0.2 / std::sqrt(x * x + y * y + z * z);
  const auto rounded = [&](double at) {
    const int kept = 2 * digits + 12;
    return kept > 53 ? at : std::ldexp(std::round(std::ldexp(at, kept)), -kept);
  };
  return {rounded(about.x + radius * x), rounded(about.y + radius * y), rounded(about.z + radius * z)};
}

/// Coordinates near 0 have more digits than integers of fixed width hold.
Point3 onSphereAboutZero(Random& random, const Point3&, int) { return tupleOnSphere(random, {0, 0, 0}, 30); }

Point3 inPlane(Random& random, const Point3& about, int) {
  const double x = random.uniform(), y = random.uniform();
  return {x, y, about.z + (random.below(4) == 0 ? 0x1p-50 : 0)};
}

Point3 pairs(Random& random, const Point3& about, int digits) {
  if (random.below(3) == 0) return anywhere(random, about, digits);
  const auto at = [&](double from) { return from + std::ldexp(random.uniform(), -2 * digits); };
  const double x = at(about.x), y = at(about.y);
  return {x, y, at(about.z)};
}

Point3 farAway(Random& random, const Point3& about, int digits) {
  const Point3 p = snapped(random, about, digits % 12 + 1);
  return {p.x + 0x1p40, p.y - 0x1p41, p.z + 0x1p38};
}

/// Their differences are subnormal, or nearly so, in one axis and ordinary in another.
Point3 ofAnySize(Random& random, const Point3&, int digits) {
  const auto at = [&] {
    const int size = random.below(2) == 0 ? 10 * digits - 150 : random.below(2) == 0 ? 195 : -1070;
    return sign(random) * std::ldexp(1 + random.uniform(), size);
  };
  const double x = at(), y = at();
  return {x, y, at()};
}

bool isIn(const std::vector<Point3>& sites, const Point3& p) {
  return std::ranges::find(sites, p) != sites.end();
}

/// Determinants of three differences, or of four and their squares, are about as small as numbers are.
Point3 tiny(Random& random, const Point3& about, int digits) {
  const Point3 p = tupleOnSphere(random, about, 2);
  const auto scaled = [&](double at) { return std::ldexp(at, (digits % 2 == 0 ? -200 : -340) - digits); };
  return {scaled(p.x), scaled(p.y), scaled(p.z)};
}

/// With up to three walls, through a coordinate of a site or mirroring one in another if that makes ties.
Tuple tupleOf(Family family, Random& random) {
  Tuple tuple;
  const int digits = static_cast<int>(random.below(24)) + 1;
  const Point3 about = anywhere(random, {}, 0);
  while (tuple.site.size() < 5) {
    const Point3 p = family(random, about, digits);
    if (!isIn(tuple.site, p)) tuple.site.push_back(p);
  }
  double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  if (random.below(2) == 0) {
    const auto pick = [&] { return tuple.site[random.below(5)]; };
    const Point3 a = pick(), b = pick(), c = pick(), d = pick();
    const double first[3] = {a.x, a.y, a.z}, other[3] = {b.x, b.y, b.z};
    const double more[3] = {(c.x + d.x) / 2, (c.y + d.y) / 2, (c.z + d.z) / 2};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min({first[k], other[k], more[k]});
      high[k] = std::max({first[k], other[k], more[k]});
    }
  }
  tuple.box = {low[0], low[1], low[2], high[0], high[1], high[2]};
  tuple.label = {0, 1, 2, 3, 4};
  const auto count = random.below(4);
  for (std::uint64_t k = 0; k < count; ++k) {
    const Label wall = labelOfWall(static_cast<int>(random.below(walls)));
    if (std::ranges::find(tuple.label, wall) == tuple.label.end()) tuple.label[1 + random.below(4)] = wall;
  }
  return tuple;
}

/// How sites weigh: not at all; at random; by few digits, so that ties remain; so that all have nearly the
/// same power, or exactly, at a point; far apart by six decades.
enum class Weighing { none, random, few_digits, all_at_a_point, decades };

void weigh(Tuple& tuple, Weighing weighing, Random& random) {
  const Point3 at = tuple.site[random.below(5)];
  const int digits = static_cast<int>(random.below(30));
  for (const Point3& p : tuple.site) {
    const double x = p.x - at.x, y = p.y - at.y, z = p.z - at.z, squared = x * x + y * y + z * z;
    double weight = 0;
    if (weighing == Weighing::random) weight = sign(random) * random.uniform() * 0.1;
    if (weighing == Weighing::few_digits) weight = std::ldexp(static_cast<double>(random.below(4)), -digits);
    if (weighing == Weighing::all_at_a_point) weight = squared + (random.below(2) == 0 ? 0.25 : 0);
    if (weighing == Weighing::decades) weight = sign(random) * std::pow(10.0, 6 * random.uniform() - 3);
    if (weighing != Weighing::none) tuple.weight.push_back(weight);
  }
}

struct Counted {
  int turns[3] = {0, 0, 0}, ties = 0, cut = 0, kept = 0;
};

Counted compare(Family family, int trials, std::uint64_t seed, Weighing weighing = Weighing::none) {
  Random random(seed);
  Counted count;
  for (int trial = 0; trial < trials && !testing::Test::HasFailure(); ++trial) {
    Tuple tuple = tupleOf(family, random);
    weigh(tuple, weighing, random);
    const Oracle oracle(tuple);
    const int turn = oracle.orientation();
    ++count.turns[turn + 1];
    EXPECT_EQ(tuple.orientation(), turn) << "trial " << trial;
    if (turn == 0) continue;
    const bool cut = oracle.cuts();
    count.ties += oracle.isTie();
    ++(cut ? count.cut : count.kept);
    EXPECT_EQ(tuple.cuts(), cut) << "trial " << trial << (oracle.isTie() ? ", a tie" : "");
    // Another cell of the vertex agrees, and so does a vertex that is named in another order.
    auto& [i, j, k, l, m] = tuple.label;
    if (!isWallLabel(k)) {
      std::swap(i, k);
      EXPECT_EQ(tuple.orientation(), -turn);
      EXPECT_EQ(tuple.cuts(), cut);
    }
    std::swap(j, l);
    EXPECT_EQ(tuple.cuts(), cut);
  }
  return count;
}

struct Kind {
  const char* name;
  Family family;
  int trials;
};

class Predicates : public testing::TestWithParam<Kind> {};

TEST_P(Predicates, AreExact) {
  const auto exact = exactSigns();
  const Counted count = compare(GetParam().family, GetParam().trials, 1);
  EXPECT_GT(count.turns[0], 0);
  EXPECT_GT(count.turns[2], 0);
  EXPECT_GT(count.cut, 0);
  EXPECT_GT(count.kept, 0);
  EXPECT_GT(exactSigns(), exact) << "the filter was not sufficient once";
}

TEST_P(Predicates, AreExactWithWeights) {
  const auto exact = exactSigns();
  for (const Weighing weighing :
       {Weighing::random, Weighing::few_digits, Weighing::all_at_a_point, Weighing::decades}) {
    SCOPED_TRACE(testing::Message() << "weighing " << static_cast<int>(weighing));
    const Counted count = compare(GetParam().family, GetParam().trials / 5, 4, weighing);
    EXPECT_GT(count.cut, 0);
    EXPECT_GT(count.kept, 0);
  }
  EXPECT_GT(exactSigns(), exact) << "the filter was not sufficient once";
}

INSTANTIATE_TEST_SUITE_P(Of, Predicates,
                         testing::Values(Kind{"Anywhere", anywhere, 20000}, Kind{"Snapped", snapped, 20000},
                                         Kind{"Lattice", latticePoint, 15000},
                                         Kind{"BoxCorner", boxCorner, 10000}, Kind{"Decimal", decimal, 10000},
                                         Kind{"OnSphere", tupleOnSphere, 20000},
                                         Kind{"OnSphereAboutZero", onSphereAboutZero, 5000},
                                         Kind{"InPlane", inPlane, 5000}, Kind{"Pairs", pairs, 5000},
                                         Kind{"FarAway", farAway, 5000}, Kind{"OfAnySize", ofAnySize, 1000},
                                         Kind{"Tiny", tiny, 20000}),
                         [](const auto& kind) { return kind.param.name; });

TEST(SpacePredicates, TiesAreAmongThese) {
  EXPECT_GT(compare(latticePoint, 5000, 2).ties, 500);
  EXPECT_GT(compare(boxCorner, 5000, 2).ties, 1500);
  EXPECT_GT(compare(snapped, 5000, 2).ties, 50);
  EXPECT_GT(compare(latticePoint, 5000, 2, Weighing::few_digits).ties, 50);
  EXPECT_GT(compare(snapped, 5000, 2, Weighing::all_at_a_point).ties, 100);
}

TEST(SpacePredicates, ATranslationByAQuantumChangesNothing) {
  Random random(3);
  int ties = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Tuple tuple = tupleOf(trial % 2 == 0 ? latticePoint : tupleOnSphere, random);
    const auto round = [](double& number) { number = std::round(number * 0x1p20) * 0x1p-20; };
    for (auto& p : tuple.site) (round(p.x), round(p.y), round(p.z));
    auto& b = tuple.box;
    for (double* offset : {&b.xmin, &b.ymin, &b.zmin, &b.xmax, &b.ymax, &b.zmax}) round(*offset);
    auto moved = tuple;
    const double dx = static_cast<double>(random.below(1000)) * 0x1p-20, dy = -0x1p20, dz = 0x1p-30;
    for (auto& p : moved.site) p = {p.x + dx, p.y + dy, p.z + dz};
    moved.box = {b.xmin + dx, b.ymin + dy, b.zmin + dz, b.xmax + dx, b.ymax + dy, b.zmax + dz};
    bool different = false;
    for (std::size_t k = 0; k < 5; ++k) {
      for (std::size_t e = 0; e < k; ++e) different = different || tuple.site[k] == tuple.site[e];
    }
    if (different || tuple.orientation() == 0) continue;
    ties += Oracle(tuple).isTie();
    EXPECT_EQ(tuple.orientation(), moved.orientation());
    EXPECT_EQ(tuple.cuts(), moved.cuts());
  }
  EXPECT_GT(ties, 500);
}

/// Two sites 1e-10 apart; the edge of i, j, k is shorter than 0, of which centers in double say 2.3e-16.
TEST(SpacePredicates, DecideWhereLengthsInDoubleDoNot) {
  Tuple tuple;
  tuple.site = {{0.750813438963927, 0.6426689233250775, 0.5964801970410043},
                {0.7508134390051346, 0.6426689233211534, 0.5964801969499739},
                {0.5822093319589013, 0.7140066664813968, 0.6601020482958477},
                {0.6387159488226736, 0.6885049167784874, 0.6731076463546524},
                {0.6077779060509136, 0.4492690757518062, 0.5354922850339192}};
  tuple.box = {0, 0, 0, 1, 1, 1};
  tuple.label = {0, 1, 2, 3, 4};
  if (tuple.orientation() < 0) std::swap(tuple.label[0], tuple.label[1]);
  EXPECT_EQ(tuple.orientation(), 1);
  EXPECT_EQ(Oracle(tuple).orientation(), 1);
  EXPECT_TRUE(tuple.cuts());
  EXPECT_TRUE(Oracle(tuple).cuts());
}

TEST(SpacePredicates, TinyNumbersAreNotFlushedToZero) {
  volatile double least_normal = 0x1p-1022, half = 0.5;
  EXPECT_GT(least_normal * half, 0);
  volatile double tiny = 0x1p-1074;
  EXPECT_GT(tiny + tiny, tiny);
}

}  // namespace
}  // namespace vorpipe::space
