#include "picture/overlay.h"

#include <gtest/gtest.h>

#include <cmath>

#include "picture/pixels.h"

namespace vorpipe::test {

using namespace core;

namespace {

constexpr std::uint32_t plain_color = 0xFFC0C0C0u;

std::size_t at(const Image& image, int row, int column) {
  return static_cast<std::size_t>(row * image.width + column);
}

/// Ids by some rule of row and column.
template <class IdOf>
Image imageOf(int width, int height, const IdOf& idOf) {
  Image image{width, height, {}, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      image.ids.push_back(idOf(row, column));
      image.rgba.push_back(image.ids.back() == no_site ? 0 : plain_color);
    }
  }
  return image;
}

constexpr std::uint32_t dark = 0xFF241812u;

void drawDots(Image& image, const Sites& sites, double size) {
  const Box domain{0, 0, 1, 1};
  SiteDots(image, sites, domain, size).draw({}, white, image);
}

/// Cells that meet along a curve, with a hole.
std::uint32_t curvedCells(int row, int column) {
  if (std::hypot(row - 30, column - 20) < 6) return no_site;
  return std::hypot(row - 10, column - 40) < 25 ? 1 : 2;
}

TEST(Overlay, WideEdgesAreAllPixelsNearAnEdgePixelAndNoOther) {
  Image thin = imageOf(67, 53, curvedCells);
  drawEdges(thin, 1, dark, 1);
  for (const double width : {1.0, 2.0, 3.0, 4.0, 4.4, 9.0, 10.0}) {
    Image wide = imageOf(67, 53, curvedCells);
    drawEdges(wide, width, dark, 2);
    // Of an even number of pixels an edge lies between two.
    const double across = std::round(width), shift = std::fmod(across, 2) == 0 ? 0.5 : 0;
    const double radius = (across - 1) / 2 + shift;
    for (int row = 0; row < wide.height; ++row) {
      for (int column = 0; column < wide.width; ++column) {
        bool near = false;
        for (int r = 0; r < wide.height; ++r) {
          for (int c = 0; c < wide.width; ++c) {
            const auto pixel = at(thin, r, c);
            const bool edge = thin.ids[pixel] != no_site && thin.rgba[pixel] != plain_color;
            near = near || (edge && std::hypot(r + shift - row, c + shift - column) <= radius);
          }
        }
        const auto pixel = at(wide, row, column);
        const bool none = wide.ids[pixel] == no_site;
        ASSERT_EQ(wide.rgba[pixel], none   ? 0
                                    : near ? dark
                                           : plain_color)
            << width << ' ' << row << ' ' << column;
      }
    }
  }
}

TEST(Overlay, EdgesAreDarkOnTheLeftAndAboveOfWhereCellsMeet) {
  Image image = imageOf(4, 4, [](int, int column) { return column < 2 ? 0u : 1u; });
  drawEdges(image, 1, dark, 1);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      EXPECT_EQ(image.rgba[at(image, row, column)] != plain_color, column == 1);
  }
}

TEST(Overlay, SmallDotsHaveNoRimAndLargeOnesHave) {
  const Sites sites{{0.5}, {0.5}, {}};
  for (const double size : {1.0, 4.0, 5.0, 20.0}) {
    Image image = imageOf(41, 41, [](int, int) { return 0u; });
    drawDots(image, sites, size);
    int white = 0, black = 0;
    for (const std::uint32_t color : image.rgba) {
      white += color == 0xFFFFFFFFu ? 1 : 0;
      black += color == 0xFF000000u ? 1 : 0;
    }
    EXPECT_GT(white, 0);
    EXPECT_EQ(black > 0, size >= 5) << size;
    EXPECT_NEAR(white + black, std::acos(-1.0) / 4 * size * size, 1 + 2 * size) << size;
  }
}

TEST(Overlay, DotsFollowTheCellsThatShowNotTheNumberOfSites) {
  Sites few{{0.25, 0.75}, {0.5, 0.5}, {}}, many = few;
  for (int i = 0; i < 1000; ++i) {
    many.x.push_back(5);
    many.y.push_back(5);
  }
  Image a = imageOf(60, 30, [](int, int column) { return column < 30 ? 0u : 1u; });
  Image b = a;
  drawDots(a, few, 0);
  drawDots(b, many, 0);
  EXPECT_EQ(a.rgba, b.rgba);
}

TEST(Frame, ADomainKeepsItsAspectInTheMiddle) {
  const PictureFrame wide = frameOf({0, 0, 2, 1}, 100, 100, Fit::letterbox);
  EXPECT_EQ(wide.left, 0);
  EXPECT_EQ(wide.top, 25);
  EXPECT_EQ(wide.width, 100);
  EXPECT_EQ(wide.height, 50);
  const PictureFrame high = frameOf({0, 0, 1, 2}, 100, 100, Fit::letterbox);
  EXPECT_EQ(high.left, 25);
  EXPECT_EQ(high.width, 50);
  EXPECT_EQ(frameOf({0, 0, 2, 1}, 100, 100, Fit::stretch).height, 100);
}

TEST(Frame, ASizeOfTheAspectButForRoundingIsFilled) {
  const Box domain{0, 0, 3, 1};
  for (int side = 1; side < 400; ++side) {
    const auto [width, height] = sizeFor(domain, side);
    const PictureFrame frame = frameOf(domain, width, height, Fit::letterbox);
    EXPECT_EQ(frame.width, width);
    EXPECT_EQ(frame.height, height);
  }
}

TEST(Frame, PixelsBesideItHaveNoSite) {
  const auto number = [](int row, int column) { return static_cast<std::uint32_t>(10 * row + column); };
  for (const PictureFrame& frame : {PictureFrame{0, 2, 4, 3}, {3, 0, 4, 3}, {1, 2, 4, 3}}) {
    Image image = imageOf(4, 3, number);
    putIntoFrame(frame, 9, 8, image);
    ASSERT_EQ(image.ids.size(), 72u);
    for (int row = 0; row < 8; ++row) {
      for (int column = 0; column < 9; ++column) {
        const int r = row - frame.top, c = column - frame.left;
        const bool inside = r >= 0 && r < 3 && c >= 0 && c < 4;
        EXPECT_EQ(image.ids[at(image, row, column)], inside ? number(r, c) : no_site);
        EXPECT_EQ(image.rgba[at(image, row, column)], inside ? plain_color : 0u);
      }
    }
  }
}

}  // namespace
}  // namespace vorpipe::test
