/// Rings of clipped cells, by hand.
#include "domain/clean_rings.h"

#include <gtest/gtest.h>

#include "unit/fixtures/outlines.h"

/// Names of its own, since sources are compiled together.
namespace vorpipe::test::cleaned {
namespace {

using core::ClippedCell;

/// One ring, all of whose edges have this neighbor.
ClippedCell cellOf(const RingPoints& ring, std::int64_t neighbor) {
  return {ring, std::vector<std::int64_t>(ring.size(), neighbor), {0}, {false}, {}};
}

const RingPoints clockwise{{0, 0}, {0, 1}, {1, 1}, {1, 0}};

TEST(CleanRings, keepPartsThatTiesTurnedAround) {
  ClippedCell cell = cellOf(clockwise, 7);
  core::cleanRings({}, {}, cell);
  EXPECT_EQ(cell.vertices, clockwise);
  EXPECT_EQ(cell.hole, std::vector<bool>{false});
}

TEST(CleanRings, leaveOutWhatRoundingTurnedAroundBesideTheOutline) {
  ClippedCell cell = cellOf(clockwise, wall_outline);
  core::cleanRings({}, {}, cell);
  EXPECT_TRUE(cell.vertices.empty());
}

std::size_t faultsOf(const ClippedCell& cell, std::uint32_t asked) {
  std::vector<core::EdgePair> faults;
  core::findFaults(cell, std::array{asked}, faults);
  return faults.size();
}

TEST(RingFaults, areEdgesThatHaveMoreInCommonThanEnds) {
  EXPECT_EQ(faultsOf(cellOf(rectangle(0, 0, 1, 1), 7), 0), 0U);
  EXPECT_EQ(faultsOf(cellOf({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 7), 0), 1U) << "they cross";
  EXPECT_EQ(faultsOf(cellOf({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}, 7), 0), 2U) << "a vertex touches one";
  EXPECT_EQ(faultsOf(cellOf({{0, 0}, {2, 0}, {1, 0}}, 7), 0), 2U) << "the others lie along it";
}

}  // namespace
}  // namespace vorpipe::test::cleaned
