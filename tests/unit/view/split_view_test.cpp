// Two pictures side by side.
#include "view/pointer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vorpipe::view {
namespace {

using ::testing::ElementsAre;

TEST(SplitView, PutsTwoPicturesSideBySide) {
  const Image first{3, 2, {1, 2, 3, 4, 5, 6}, {}}, other{3, 2, {7, 8, 9, 10, 11, 12}, {}};
  SplitView split;
  EXPECT_THAT(split.join(first, other, 1).rgba, ElementsAre(1, 8, 9, 4, 11, 12));
  EXPECT_EQ(split.join(first, other, 3).rgba, first.rgba);
  EXPECT_EQ(split.join(first, other, -4).rgba, other.rgba);
}

TEST(SplitView, IsDraggedByItsLine) {
  SplitView split;
  double at = 0.5;
  EXPECT_FALSE(split.take(Press{}, Position{90, 5}, 200, 5, at));
  EXPECT_FALSE(split.take(Move{{50, 5}}, Position{90, 5}, 200, 5, at));
  EXPECT_TRUE(split.take(Press{}, Position{104, 5}, 200, 5, at));
  EXPECT_TRUE(split.take(Move{{50, 5}}, Position{104, 5}, 200, 5, at));
  EXPECT_EQ(at, 0.25);
  EXPECT_TRUE(split.take(Move{{-50, 5}}, Position{50, 5}, 200, 5, at));
  EXPECT_EQ(at, 0);
  EXPECT_TRUE(split.take(Release{}, Position{-50, 5}, 200, 5, at));
  EXPECT_FALSE(split.take(Move{{50, 5}}, Position{-50, 5}, 200, 5, at));
  EXPECT_EQ(at, 0);
}

}  // namespace
}  // namespace vorpipe::view
