// Two pictures side by side.
#include "view/wipe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vorpipe::view {
namespace {

using ::testing::ElementsAre;

TEST(Wipe, PutsTwoPicturesSideBySide) {
  const Image first{3, 2, {1, 2, 3, 4, 5, 6}, {}}, other{3, 2, {7, 8, 9, 10, 11, 12}, {}};
  Wipe wipe;
  EXPECT_THAT(wipe.put(first, other, 1).rgba, ElementsAre(1, 8, 9, 4, 11, 12));
  EXPECT_EQ(wipe.put(first, other, 3).rgba, first.rgba);
  EXPECT_EQ(wipe.put(first, other, -4).rgba, other.rgba);
}

TEST(Wipe, IsDraggedByItsLine) {
  Wipe wipe;
  double at = 0.5;
  EXPECT_FALSE(wipe.take(Press{}, Place{90, 5}, 200, 5, at));
  EXPECT_FALSE(wipe.take(Move{{50, 5}}, Place{90, 5}, 200, 5, at));
  EXPECT_TRUE(wipe.take(Press{}, Place{104, 5}, 200, 5, at));
  EXPECT_TRUE(wipe.take(Move{{50, 5}}, Place{104, 5}, 200, 5, at));
  EXPECT_EQ(at, 0.25);
  EXPECT_TRUE(wipe.take(Move{{-50, 5}}, Place{50, 5}, 200, 5, at));
  EXPECT_EQ(at, 0);
  EXPECT_TRUE(wipe.take(Release{}, Place{-50, 5}, 200, 5, at));
  EXPECT_FALSE(wipe.take(Move{{50, 5}}, Place{-50, 5}, 200, 5, at));
  EXPECT_EQ(at, 0);
}

}  // namespace
}  // namespace vorpipe::view
