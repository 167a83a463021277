// The line around the cell under the pointer.
#include "view/cell_border.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace vorpipe::view {
namespace {

/// A letter is a site, a dot none.
Image imageOf(const std::vector<std::string>& rows) {
  Image image{static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), {}, {}};
  for (const std::string& row : rows) {
    for (const char letter : row)
      image.ids.push_back(letter == '.' ? no_site : static_cast<std::uint32_t>(letter));
  }
  return image;
}

/// Twice the area inside a closed line; positive if it turns clockwise, y downward.
double twiceArea(const std::vector<Position>& line) {
  double sum = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Position &a = line[k], &b = line[(k + 1) % line.size()];
    sum += a.x * b.y - b.x * a.y;
  }
  return sum;
}

TEST(CellBorder, RunsAroundOnePixelThroughTheMiddlesOfItsSides) {
  const std::vector<Position> line = borderAround(imageOf({"aaa", "aba", "aaa"}), 1, 1);
  EXPECT_THAT(line, ::testing::UnorderedElementsAre(Position{1, 1.5}, Position{1.5, 1}, Position{2, 1.5},
                                                    Position{1.5, 2}));
  EXPECT_EQ(twiceArea(line), 1);
}

TEST(CellBorder, HasOnlyTheEndsOfStraightParts) {
  const std::vector<Position> line = borderAround(imageOf({"aaaa", "aaaa", "bbbb"}), 1, 2);
  EXPECT_LE(line.size(), 8u);
  // The whole rectangle but its cut corners, each an eighth.
  EXPECT_EQ(twiceArea(line), 2 * (8 - 4 * 0.125));
}

TEST(CellBorder, StaysAtConnectedPixels) {
  const Image image = imageOf({"a.aa", "b.ba", ".aab"});
  EXPECT_EQ(twiceArea(borderAround(image, 0, 0)), 1);
  for (const Position& at : borderAround(image, 0, 3)) {
    EXPECT_TRUE(at.x >= 2 && at.x <= 4 && at.y >= 0 && at.y <= 2) << at.x << ' ' << at.y;
  }
}

TEST(CellBorder, IsEmptyWhereNoSiteIs) {
  const Image image = imageOf({"a.", "aa"});
  EXPECT_TRUE(borderAround(image, 0, 1).empty());
  EXPECT_TRUE(borderAround(image, -1, 0).empty());
  EXPECT_TRUE(borderAround(image, 0, 2).empty());
  EXPECT_FALSE(borderAround(image, 1, 1).empty());
}

TEST(CellBorder, OfADiscIsACircle) {
  Image image{80, 60, {}, {}};
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      image.ids.push_back(std::hypot(column + 0.5 - 40, row + 0.5 - 30) < 20 ? 1 : 2);
    }
  }
  const std::vector<Position> line = borderAround(image, 22, 47);
  ASSERT_GT(line.size(), 40u);
  for (const Position& at : line) EXPECT_NEAR(std::hypot(at.x - 40, at.y - 30), 20, 0.8);
  EXPECT_NEAR(twiceArea(line), 2 * 3.14159 * 400, 60);
}

}  // namespace
}  // namespace vorpipe::view
