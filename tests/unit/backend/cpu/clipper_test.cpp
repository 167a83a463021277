/// The functions of shaders/glsl/cell.glsl, as the C++ compiler understands them.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "backend/cpu/clipper.h"

namespace vorpipe::cpu {
namespace {

#include "strip.glsl"

template <class Real>
struct Cut : testing::Test {
  using Clip = Clipper<Real, 12>;
  using Cell = typename Clip::Cell;
  using vec2 = typename Clip::vec2;
  using vec4 = typename Clip::vec4;
  static constexpr Real eps = std::numeric_limits<Real>::epsilon();

  Cell square() {  // [-1, 1] x [-1, 1]
    Cell cell;
    clip.beginCell(cell, vec4(-1, -1, 1, 1));
    return cell;
  }

  int edges(const Cell& cell) {
    int count = 0;
    for (int k = 0; k < Clip::MAX_EDGES; ++k) count += clip.isEdge(cell, k) ? 1 : 0;
    return count;
  }

  /// Half the sum of h times length: right for cells whose origin is anywhere.
  Real area(const Cell& cell) {
    Real sum = 0;
    for (int k = 0; k < Clip::MAX_EDGES; ++k) {
      if (clip.isEdge(cell, k)) sum += cell.h[k] * (cell.hi[k] - cell.lo[k]) / 2;
    }
    return sum;
  }

  Clip clip;
};

using Numbers = testing::Types<float, double>;
TYPED_TEST_SUITE(Cut, Numbers);

TYPED_TEST(Cut, beginsAsTheDomain) {
  auto cell = this->square();
  EXPECT_EQ(this->edges(cell), 4);
  EXPECT_EQ(this->area(cell), 4);
  EXPECT_EQ(this->clip.squaredRadius(cell), 2);
  EXPECT_TRUE(this->clip.isClosed(cell));
}

TYPED_TEST(Cut, leavesTheCellAloneWhenTheLineMisses) {
  auto cell = this->square();
  this->clip.cutCell(cell, {TypeParam(0.6), TypeParam(0.8)}, 2, 7);
  EXPECT_EQ(this->edges(cell), 4);
  EXPECT_EQ(this->area(cell), 4);
}

TYPED_TEST(Cut, takesACornerOff) {
  auto cell = this->square();
  const TypeParam half = std::sqrt(TypeParam(0.5));
  this->clip.cutCell(cell, {half, half}, half, 7);  // x + y <= 1
  EXPECT_EQ(this->edges(cell), 5);
  EXPECT_NEAR(this->area(cell), 3.5, 8 * TestFixture::eps);
  EXPECT_TRUE(this->clip.isClosed(cell));
}

TYPED_TEST(Cut, dropsAnEdgeThatIsWhollyOutside) {
  auto cell = this->square();
  this->clip.cutCell(cell, {1, 0}, TypeParam(0.25), 7);
  EXPECT_EQ(this->edges(cell), 4);
  EXPECT_EQ(this->area(cell), TypeParam(2.5));
  std::set<int> lines;
  for (int k = 0; k < 12; ++k) {
    if (this->clip.isEdge(cell, k)) lines.insert(cell.line[k]);
  }
  EXPECT_EQ(lines, (std::set<int>{WALL_XMIN, WALL_YMIN, WALL_YMAX, 7}));
}

TYPED_TEST(Cut, ofTwoEqualLinesKeepsTheFirst) {
  auto cell = this->square();
  this->clip.cutCell(cell, {1, 0}, TypeParam(0.25), 7);
  this->clip.cutCell(cell, {1, 0}, TypeParam(0.25), 8);
  EXPECT_EQ(this->edges(cell), 4);
  EXPECT_EQ(this->area(cell), TypeParam(2.5));
}

TYPED_TEST(Cut, emptiesACellThatLiesBeyondTheLine) {
  auto cell = this->square();
  this->clip.cutCell(cell, {1, 0}, -2, 7);
  EXPECT_EQ(this->edges(cell), 0);
  EXPECT_TRUE(cell.empty);
  EXPECT_LT(this->clip.squaredRadius(cell), 0);
}

TYPED_TEST(Cut, emptiesACellBetweenOppositeLines) {
  auto cell = this->square();
  this->clip.cutCell(cell, {1, 0}, TypeParam(-0.25), 7);
  this->clip.cutCell(cell, {-1, 0}, TypeParam(0.125), 8);
  EXPECT_EQ(this->edges(cell), 0);
}

TYPED_TEST(Cut, nearlyParallelLinesKeepTheShape) {
  const TypeParam tilt = 3 * TestFixture::eps;
  auto cell = this->square();
  this->clip.cutCell(cell, {1, 0}, TypeParam(0.5), 7);
  this->clip.cutCell(cell, {1, tilt}, TypeParam(0.5), 8);
  EXPECT_NEAR(this->area(cell), 3, 32 * TestFixture::eps);
  EXPECT_TRUE(this->clip.isClosed(cell));
}

TYPED_TEST(Cut, saysSoWhenThereIsNoRoom) {
  auto cell = this->square();
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * M_PI * i / 12;
    this->clip.cutCell(cell, {TypeParam(std::cos(angle)), TypeParam(std::sin(angle))}, TypeParam(0.5), i);
  }
  EXPECT_EQ(this->edges(cell), 12);
  EXPECT_FALSE(cell.overflow);
  this->clip.cutCell(cell, {TypeParam(std::cos(0.26)), TypeParam(std::sin(0.26))}, TypeParam(0.5), 12);
  EXPECT_TRUE(cell.overflow);
}

TYPED_TEST(Cut, ranksEdgesCounterclockwise) {
  auto cell = this->square();
  for (int i = 0; i < 5; ++i) {
    const double angle = 2.0 * i * i + 0.1;
    this->clip.cutCell(cell, {TypeParam(std::cos(angle)), TypeParam(std::sin(angle))}, TypeParam(0.8), i);
  }
  typename TestFixture::Clip::Order order;
  this->clip.orderEdges(cell, order);
  ASSERT_EQ(order.count, this->edges(cell));
  TypeParam twice = 0;
  for (int r = 0; r < order.count; ++r) {
    const auto a = this->clip.startOfRank(cell, order, r);
    const auto b = this->clip.startOfRank(cell, order, (r + 1) % order.count);
    const auto c = this->clip.startOfRank(cell, order, (r + 2) % order.count);
    EXPECT_GT((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x), 0) << "at rank " << r;
    twice += a.x * b.y - a.y * b.x;
  }
  EXPECT_NEAR(twice / 2, this->area(cell), 64 * TestFixture::eps);
}

TYPED_TEST(Cut, pseudoAngleGrowsWithTheAngle) {
  TypeParam last = -10;
  for (int i = -179; i <= 179; ++i) {
    const double angle = i * M_PI / 180;
    const auto next = this->clip.pseudoAngle(TypeParam(std::cos(angle)), TypeParam(std::sin(angle)));
    EXPECT_GT(next, last) << i << " degrees";
    last = next;
  }
}

TEST(Strip, visitsEveryVertexOnceFromBothSides) {
  for (int n = 3; n <= 13; ++n) {
    std::set<int> ranks;
    for (int index = 0; index < n; ++index) ranks.insert(rankInStrip(index, n));
    EXPECT_EQ(ranks.size(), static_cast<std::size_t>(n));
    EXPECT_EQ(*ranks.begin(), 0);
    EXPECT_EQ(*ranks.rbegin(), n - 1);
  }
  EXPECT_EQ(rankInStrip(1, 5), 1);
  EXPECT_EQ(rankInStrip(2, 5), 4);
  EXPECT_EQ(rankInStrip(3, 5), 2);
}

TYPED_TEST(Cut, certifiesOnlyWithinReach) {
  // A lattice neighborhood: the cell is [-0.5, 0.5]^2, its radius of security sqrt(2).
  const HalfPlane<TypeParam> lines[] = {{1, 0, TypeParam(0.5), TypeParam(0.999)},
                                        {-1, 0, TypeParam(0.5), TypeParam(0.999)},
                                        {0, 1, TypeParam(0.5), TypeParam(0.999)},
                                        {0, -1, TypeParam(0.5), TypeParam(0.999)}};
  const auto statusWithReach = [&](TypeParam reach, TypeParam origin_offset) {
    this->clip.lines = lines;
    typename TestFixture::Cell cell;
    return this->clip.clipCell(cell, {-9, -9, 9, 9}, {0, 0}, 0, 4, reach, origin_offset);
  };
  EXPECT_EQ(statusWithReach(TypeParam(1.41), 0), CELL_UNSECURED);
  EXPECT_EQ(statusWithReach(TypeParam(1.42), 0), CELL_CERTIFIED);
  EXPECT_EQ(statusWithReach(TypeParam(1.42), TypeParam(0.1)), CELL_UNSECURED);
}

TYPED_TEST(Cut, anOutsetMovesEveryLineOutward) {
  const HalfPlane<TypeParam> lines[] = {{1, 0, TypeParam(0.5), 0}};
  this->clip.lines = lines;
  typename TestFixture::Cell cell;
  this->clip.clipCell(cell, {-1, -1, 1, 1}, {TypeParam(0.25), TypeParam(0.125)}, 0, 1, 100, 0);
  EXPECT_EQ(this->area(cell), TypeParam(2 * 2.25));
}

}  // namespace
}  // namespace vorpipe::cpu
