#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

using ::testing::HasSubstr;

MendedOutline mend(const Outline& outline, bool repair) {
  auto result = mended(outline, repair);
  EXPECT_TRUE(result) << result.error().message;
  if (!result) return {};
  // What comes out is what runs take.
  const auto checked = checkInput(Sites{{0}, {0}, {}}, inside(result->outline, {-100, -100, 100, 100}));
  EXPECT_TRUE(checked) << checked.error().message;
  return std::move(*result);
}

std::size_t polygonsOf(const Outline& outline) { return outline.polygon_offsets.size() - 1; }
std::size_t ringsOf(const Outline& outline) { return outline.ring_offsets.size() - 1; }

std::string refusalOf(const Outline& outline, bool repair) {
  const auto result = mended(outline, repair);
  if (result) return "taken";
  EXPECT_EQ(result.error().code, ErrorCode::input);
  EXPECT_EQ(result.error().subject, Subject::outline);
  return result.error().message;
}

TEST(Mended, whatIsValidStaysAsItIs) {
  // Polygons may touch in points.
  for (const Outline& outline :
       {country(500), outlineOf({{rectangle(0, 0, 1, 1)}, {rectangle(1, 1, 2, 2)}})}) {
    for (const bool repair : {false, true}) {
      const MendedOutline same = mend(outline, repair);
      EXPECT_EQ(same.changes, "");
      EXPECT_EQ(same.outline.points, outline.points);
      EXPECT_EQ(same.outline.ring_offsets, outline.ring_offsets);
    }
  }
  EXPECT_TRUE(mended({}, true)->outline.empty());
}

TEST(Mended, polygonsThatTouchAlongSidesBecomeOne) {
  const MendedOutline one =
      mend(outlineOf({{rectangle(0, 0, 1, 1)}, {rectangle(1, 0, 2, 1)}, {rectangle(5, 5, 6, 6)}}), false);
  EXPECT_EQ(polygonsOf(one.outline), 2u);
  EXPECT_DOUBLE_EQ(outlineArea(one.outline), 3);
  EXPECT_EQ(one.changes, "3 polygons that touch dissolved into 2");
}

TEST(Mended, polygonsThatOverlapAreCountedOnce) {
  const MendedOutline one = mend(outlineOf({{rectangle(0, 0, 2, 2)}, {rectangle(1, 1, 3, 3)}}), false);
  EXPECT_EQ(polygonsOf(one.outline), 1u);
  EXPECT_DOUBLE_EQ(outlineArea(one.outline), 7);
  EXPECT_EQ(one.changes,
            "2 polygons that overlap dissolved into 1, the area of all was 8, without overlaps it is 7");
  const Outline nested = outlineOf({{rectangle(0, 0, 3, 3)}, {rectangle(1, 1, 2, 2)}});
  EXPECT_DOUBLE_EQ(outlineArea(mend(nested, false).outline), 9);
  const Outline twice = outlineOf({{rectangle(0, 0, 3, 3)}, {rectangle(0, 0, 3, 3)}});
  EXPECT_DOUBLE_EQ(outlineArea(mend(twice, false).outline), 9);
}

TEST(Mended, aPolygonFillsAHoleOfAnother) {
  const Outline enclave =
      outlineOf({{rectangle(0, 0, 3, 3), rectangle(1, 1, 2, 2)}, {rectangle(1, 1, 2, 2)}});
  const MendedOutline one = mend(enclave, false);
  EXPECT_EQ(ringsOf(one.outline), 1u);
  EXPECT_DOUBLE_EQ(outlineArea(one.outline), 9);
}

TEST(Mended, sidesThatMissEachOtherByRoundingLeaveNoSlivers) {
  // The middle of a side is a corner of the other polygon, as near to it as doubles allow.
  const double x = 1.0 / 3, y = 0.7 / 3;
  const MendedOutline one =
      mend(outlineOf({{{{0, 0}, {1, 0.7}, {0, 1}}}, {{{0, 0}, {1, -1}, {1, 0.7}, {x, y}}}}), false);
  EXPECT_EQ(ringsOf(one.outline), 1u);
  EXPECT_NEAR(outlineArea(one.outline), 0.5 + 0.85, 1e-12);
}

TEST(Mended, ringsThatCrossThemselvesAreRefusedUnlessRepaired) {
  const Outline bow = outlineOf({{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}});
  EXPECT_THAT(refusalOf(bow, false), HasSubstr("Self-intersection at (0.5, 0.5)"));
  const MendedOutline both = mend(bow, true);
  EXPECT_EQ(polygonsOf(both.outline), 2u);
  EXPECT_DOUBLE_EQ(outlineArea(both.outline), 0.5);
  EXPECT_EQ(both.changes,
            "1 of 1 polygons repaired, the first for a Self-intersection at (0.5, 0.5): their rings "
            "were 1 and are 2, their area was 0 and is 0.5");
}

TEST(Mended, spikesAreCutOff) {
  const Outline spike = outlineOf({{{{0, 0}, {1, 0}, {1, 1}, {3, 1}, {1, 1}, {0, 1}}}});
  EXPECT_NE(refusalOf(spike, false), "taken");
  const MendedOutline square = mend(spike, true);
  EXPECT_DOUBLE_EQ(outlineArea(square.outline), 1);
  EXPECT_DOUBLE_EQ(boxOf(square.outline.points).xmax, 1);
}

TEST(Mended, holesTakeAwayOnlyWhatIsThere) {
  const Outline across = outlineOf({{rectangle(0, 0, 2, 2), rectangle(1, 0.5, 3, 1.5)}});
  EXPECT_NE(refusalOf(across, false), "taken");
  EXPECT_DOUBLE_EQ(outlineArea(mend(across, true).outline), 3);
  const Outline beside = outlineOf({{rectangle(0, 0, 2, 2), rectangle(5, 5, 6, 6)}});
  EXPECT_DOUBLE_EQ(outlineArea(mend(beside, true).outline), 4);
}

TEST(Mended, whatEdgesWindAroundTwiceIsOutside) {
  // The second turn goes along the first for a part of it.
  const Outline twice = outlineOf({{{{0, 0}, {4, 0}, {4, 3}, {0, 3}, {0, 0}, {2, 0}, {2, 2}, {0, 2}}}});
  EXPECT_DOUBLE_EQ(outlineArea(mend(twice, true).outline), 8);
}

TEST(Mended, manyCrossingsAndHolesAreOneRepair) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> at(0, 10);
  RingPoints ring;
  for (int k = 0; k < 150; ++k) ring.push_back({at(random), at(random)});
  EXPECT_GT(outlineArea(mend(outlineOf({{ring}}), true).outline), 30);
  std::vector<RingPoints> rings{rectangle(0, 0, 80, 10)};
  for (int k = 0; k < 400; ++k)
    rings.push_back(rectangle(k / 5, 2 * (k % 5), k / 5 + 0.5, 2 * (k % 5) + 0.5));
  rings.push_back(rectangle(79.75, 4.75, 81, 5));
  EXPECT_NEAR(outlineArea(mend(outlineOf({rings}), true).outline), 800 - 400 * 0.25 - 0.0625, 1e-9);
}

TEST(Mended, whatHasNoAreaIsRefused) {
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {1, 1}, {0, 0.0}}}, {{{0, 0}, {2, 2}, {1, 1}}}}), true),
              HasSubstr("has an area"));
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {1, 1}}}}), true), HasSubstr("needs 3 or more"));
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {1, 1}, {std::nan(""), 0}}}}), true), HasSubstr("not finite"));
}

/// Rectangles of whole numbers, so that unit squares tell the area of their union.
TEST(Mended, theAreaOfManyRectanglesIsThatOfTheirUnitSquares) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> at(0, 15), size(1, 5);
  for (int round = 0; round < 100; ++round) {
    std::vector<std::vector<RingPoints>> polygons;
    std::set<std::pair<int, int>> squares;
    for (int k = 0; k < 2 + round / 5; ++k) {
      const int x = at(random), y = at(random), w = size(random), h = size(random);
      polygons.push_back({rectangle(x, y, x + w, y + h)});
      for (int i = 0; i < w; ++i) {
        for (int j = 0; j < h; ++j) squares.emplace(x + i, y + j);
      }
    }
    EXPECT_DOUBLE_EQ(outlineArea(mend(outlineOf(polygons), false).outline),
                     static_cast<double>(squares.size()))
        << "round " << round;
  }
}

bool isInside(const Outline& outline, Point p) {
  bool odd = false;
  for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
    const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
    for (auto k = begin; k < end; ++k) {
      const Point a = outline.points[k], b = outline.points[k + 1 < end ? k + 1 : begin];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
    }
  }
  return odd;
}

TEST(Mended, aTangledRingKeepsWhatItWindsAroundAnOddNumberOfTimes) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> at(0, 10);
  for (int round = 0; round < 30; ++round) {
    RingPoints ring;
    for (int k = 0; k < 4 + round / 3; ++k) ring.push_back({at(random), at(random)});
    const Outline tangle = outlineOf({{ring}});
    const Outline after = mend(tangle, true).outline;
    for (int k = 0; k < 200; ++k) {
      const Point p{at(random), at(random)};
      EXPECT_EQ(isInside(after, p), isInside(tangle, p)) << "round " << round << ": " << p.x << ", " << p.y;
    }
  }
}

}  // namespace
}  // namespace vorpipe::test
