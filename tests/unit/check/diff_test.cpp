#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "unit/check/diff_pictures.h"
#include "unit/fixtures/checked_runs.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

/// Two sites whose bisector is vertical, `offset` pixels right of the centers of column 80.
Sites beside(double offset, const Box& domain) {
  const double middle = (80.5 + offset) / picture_width;
  Sites sites;
  for (const double x : {middle - 0.25, middle + 0.25}) {
    sites.x.push_back(domain.xmin + x * (domain.xmax - domain.xmin));
    sites.y.push_back(domain.ymin + 0.3 * (domain.ymax - domain.ymin));
  }
  return sites;
}

/// Site 0 left of column `first`, site 1 from there on.
Ids halves(int first) {
  Ids ids(at(picture_height, 0));
  for (int row = 0; row < picture_height; ++row) {
    for (int column = 0; column < picture_width; ++column) ids[at(row, column)] = column < first ? 0 : 1;
  }
  return ids;
}

TEST(DiffIds, tiesEndAtTheTieDistance) {
  for (const Box& domain :
       {unit, Box{0, 0, 40, 1}, Box{500000, 5200000, 500001, 5200001}, Box{-1e-9, 0, 1e-9, 1e-9}}) {
    for (const double sign : {-1.0, 1.0}) {
      const auto inside = diffIds(halves(80), halves(81), picture_width, picture_height,
                                  beside(sign * 0.99 * tie_distance, domain), domain);
      ASSERT_TRUE(inside);
      EXPECT_EQ(inside->ties, static_cast<std::uint64_t>(picture_height));
      EXPECT_TRUE(inside->agree());
      EXPECT_NEAR(inside->widest_tie, 0.99 * tie_distance, 1e-6);
      const auto outside = diffIds(halves(80), halves(81), picture_width, picture_height,
                                   beside(sign * 1.01 * tie_distance, domain), domain);
      ASSERT_TRUE(outside);
      EXPECT_EQ(outside->wrong, static_cast<std::uint64_t>(picture_height));
      EXPECT_EQ(outside->first.size(), 10u);
      EXPECT_NEAR(outside->worst.distance, 1.01 * tie_distance, 1e-6);
    }
  }
}

TEST(DiffIds, distancesAreInPixelsThatAreNotSquare) {
  // Pixels are 1 wide and 4 high in units of the sites; the bisector is x + y = 0.5 + 0.5 * 4, through
  // the center of the pixel at the bottom left, and crosses the center of its right neighbor at (1, 0).
  const Box domain{0, 0, 1.0 * picture_width, 4.0 * picture_height};
  Sites sites;
  sites.x = {0, 2.5};
  sites.y = {0, 2.5};
  Ids a(at(picture_height, 0), 0), b = a;
  b[at(picture_height - 1, 1)] = 1;
  const auto diff = diffIds(a, b, picture_width, picture_height, sites, domain);
  ASSERT_TRUE(diff);
  ASSERT_EQ(diff->wrong, 1u);
  // In pixels the line is X + 4 Y = 2.5: the center (1.5, 0.5) is 1 / sqrt(17) from it.
  EXPECT_NEAR(diff->worst.distance, 1 / std::sqrt(17.0), 1e-12);
}

TEST(DiffIds, distancesAreByWeight) {
  // The bisector of beside(0, domain) moves by the difference of weights / (2 * 0.5 * side): here by 3
  // pixels, to the right.
  for (const double side : {1.0, 40.0}) {
    const Box domain{0, 0, side, side * picture_height / picture_width};
    auto sites = beside(0, domain);
    sites.weight = {7 + 0.5 * 2 * 3.0 / picture_width * side * side, 7};
    const auto right = diffIds(halves(83), halves(84), picture_width, picture_height, sites, domain);
    ASSERT_TRUE(right);
    EXPECT_EQ(right->ties, static_cast<std::uint64_t>(picture_height));
    EXPECT_NEAR(right->widest_tie, 0, 1e-9);
    const auto wrong = diffIds(halves(80), halves(81), picture_width, picture_height, sites, domain);
    ASSERT_TRUE(wrong);
    EXPECT_EQ(wrong->wrong, static_cast<std::uint64_t>(picture_height));
    EXPECT_NEAR(wrong->worst.distance, 3, 1e-9);
  }
}

TEST(DiffIds, aTieNeedsABoundaryBesideIt) {
  const auto diff = diffIds(Ids(at(picture_height, 0), 0), Ids(at(picture_height, 0), 1), picture_width,
                            picture_height, beside(0, unit), unit);
  ASSERT_TRUE(diff);
  EXPECT_EQ(diff->ties, 2u) << "only where the column meets the frame";
  EXPECT_EQ(diff->wrong, at(picture_height, 0) - 2);
}

TEST(DiffIds, everythingATieIsRefused) {
  // Site 1 + r mirrors site 0 at the centers of row r, so that every pixel of `b` is a tie.
  Sites sites;
  sites.x = {0.5};
  sites.y = {-1};
  Ids a(at(picture_height, 0), 0), b = a;
  for (int row = 0; row < picture_height; ++row) {
    sites.x.push_back(0.5);
    sites.y.push_back(2 * (1 - (row + 0.5) / picture_height) + 1);
    for (int column = 0; column < picture_width; ++column)
      b[at(row, column)] = static_cast<std::uint32_t>(row + 1);
  }
  const auto diff = diffIds(a, b, picture_width, picture_height, sites, unit);
  ASSERT_TRUE(diff);
  EXPECT_EQ(diff->wrong, 0u);
  EXPECT_EQ(diff->ties, at(picture_height, 0));
  EXPECT_FALSE(diff->agree());
}

TEST(DiffIds, aLatticeMayTieOnEveryBoundary) {
  // 3 x 3 pixels for a cell whose walls run through pixel centers.
  Sites sites;
  constexpr int across = picture_width / 3 + 2, up = picture_height / 3 + 2;
  for (int row = 0; row < up; ++row) {
    for (int column = 0; column < across; ++column) {
      sites.x.push_back((3 * column - 1.0) / picture_width);
      sites.y.push_back(1 - (3 * row - 1.0) / picture_height);
    }
  }
  const auto drawn = [&](double centers_at) {
    Ids ids(at(picture_height, 0));
    for (int row = 0; row < picture_height; ++row) {
      for (int column = 0; column < picture_width; ++column) {
        const int cell_row = static_cast<int>(std::floor((row + centers_at + 2.5) / 3));
        const int cell_column = static_cast<int>(std::floor((column + centers_at + 2.5) / 3));
        ids[at(row, column)] = static_cast<std::uint32_t>(cell_row * across + cell_column);
      }
    }
    return ids;
  };
  const auto diff = diffIds(drawn(0.499), drawn(0.501), picture_width, picture_height, sites, unit);
  ASSERT_TRUE(diff);
  EXPECT_GT(diff->ties, at(picture_height, 0) / 2);
  EXPECT_EQ(diff->wrong, 0u);
  EXPECT_TRUE(diff->agree()) << diff->ties << " ties, " << diff->ties_allowed << " allowed";
}

TEST(DiffIds, duplicatesAndUnknownSitesAreWrong) {
  Sites sites = beside(0, unit);
  sites.x.push_back(sites.x[0]);
  sites.y.push_back(sites.y[0]);
  for (const std::uint32_t stranger : {2u, 3u, no_site}) {
    Ids b = halves(80);
    b[at(7, 9)] = stranger;
    const auto diff = diffIds(halves(80), b, picture_width, picture_height, sites, unit);
    ASSERT_TRUE(diff);
    EXPECT_EQ(diff->wrong, 1u);
    EXPECT_EQ(diff->first.front().row, 7);
    EXPECT_EQ(diff->first.front().column, 9);
  }
}

TEST(DiffIds, withoutSitesEveryDifferenceIsWrong) {
  const IdDiff diff = diffIds(halves(80), halves(81), picture_width, picture_height);
  EXPECT_EQ(diff.wrong, static_cast<std::uint64_t>(picture_height));
  EXPECT_EQ(diff.ties, 0u);
  EXPECT_FALSE(diff.agree());
  EXPECT_TRUE(diffIds(halves(80), halves(80), picture_width, picture_height).agree());
}

TEST(DiffIds, aDomainThatIsNoBoxIsRefused) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const Box& domain : {Box{1, 0, 0, 1}, Box{0, 0, 1, not_a_number}, Box{-1e308, 0, 1e308, 1}}) {
    const auto diff = diffIds(halves(80), halves(81), picture_width, picture_height, beside(0, unit), domain);
    ASSERT_FALSE(diff);
    EXPECT_EQ(diff.error().code, ErrorCode::input);
  }
}

TEST(DiffImages, countsWhereAndHowMuch) {
  std::vector<std::uint32_t> a(at(picture_height, 0), 0xFF102030u), b = a;
  b[at(10, 20)] = 0xFF102031u;
  b[at(30, 5)] = 0xFF902030u;
  const ImageDiff diff = diffImages(a, b, picture_width, picture_height);
  EXPECT_EQ(diff.different, 2u);
  EXPECT_EQ(diff.largest, 0x80);
  EXPECT_EQ(diff.first_row, 10);
  EXPECT_EQ(diff.first_column, 20);
  EXPECT_EQ(diff.top, 10);
  EXPECT_EQ(diff.bottom, 30);
  EXPECT_EQ(diff.left, 5);
  EXPECT_EQ(diff.right, 20);
  EXPECT_EQ(std::ranges::count(diff.pixels, PixelMatch::wrong), 2);
  EXPECT_EQ(diffImages(a, a, picture_width, picture_height).different, 0u);
}

TEST(DiffImages, pixelsWithinTheToleranceAreClose) {
  std::vector<std::uint32_t> a(at(picture_height, 0), 0xFF102030u), b = a;
  b[at(10, 20)] = 0xFF102033u;
  b[at(30, 5)] = 0xFF142030u;
  const ImageDiff diff = diffImages(a, b, picture_width, picture_height, 3);
  EXPECT_EQ(diff.close, 1u);
  EXPECT_EQ(diff.different, 1u);
  EXPECT_EQ(diff.largest, 4);
  EXPECT_EQ(diff.first_row, 30);
  ASSERT_EQ(diff.first.size(), 1u);
  EXPECT_EQ(diff.first.front().b, 0xFF142030u);
  EXPECT_EQ(diff.pixels[at(10, 20)], PixelMatch::tie);
  EXPECT_EQ(diff.pixels[at(30, 5)], PixelMatch::wrong);
}

class DiffCells : public ::testing::Test {
 protected:
  static const Diagram& rightCells() {
    static const Diagram right = cellsOf(mixedSites(), unit_cells);
    return right;
  }
  [[nodiscard]] CellsDiff diff() const { return *diffCells(rightCells(), cells); }

  Diagram cells = rightCells();
};

TEST_F(DiffCells, FindsNothingInEqualOnes) {
  const CellsDiff found = diff();
  EXPECT_TRUE(found.agree());
  EXPECT_EQ(found.equal, cells.status.size());
  EXPECT_EQ(found.worst_area, 0);
  EXPECT_TRUE(found.first.empty());
}

TEST_F(DiffCells, LetsACellBeginAnywhere) {
  const auto begin = cells.neighbors.begin() + static_cast<std::ptrdiff_t>(cells.cell_offsets[4]);
  const auto end = cells.neighbors.begin() + static_cast<std::ptrdiff_t>(cells.cell_offsets[5]);
  std::rotate(begin, begin + 1, end);
  EXPECT_TRUE(diff().agree());
}

TEST_F(DiffCells, FindsStatusesAndOwners) {
  cells.status[3] = Status::empty;
  cells.owner[200] = 6;
  const CellsDiff found = diff();
  EXPECT_FALSE(found.agree());
  EXPECT_EQ(found.statuses, 2u);
  ASSERT_EQ(found.first.size(), 2u);
  EXPECT_EQ(found.first[0].site, 3u);
  EXPECT_TRUE(found.first[1].status);
  EXPECT_FALSE(found.first[1].neighbors || found.first[1].area);
}

TEST_F(DiffCells, FindsNeighbors) {
  cells.neighbors[cells.cell_offsets[9]] = 50;
  EXPECT_EQ(diff().neighbors, 1u);
  cells = rightCells();
  const auto wall = std::ranges::find_if(cells.neighbors, [](std::int64_t n) { return n < 0; });
  *wall = *wall == wall_xmin ? wall_xmax : wall_xmin;
  EXPECT_EQ(diff().neighbors, 1u);
  cells = rightCells();
  cells.neighbors.pop_back();
  for (std::size_t i = 10; i < cells.cell_offsets.size(); ++i) --cells.cell_offsets[i];
  EXPECT_FALSE(diff().agree());
}

TEST_F(DiffCells, AllowsWhatIsPromisedOfAreas) {
  cells.area[9] *= 1 + 0.99e-5;
  EXPECT_TRUE(diff().agree());
  EXPECT_EQ(diff().worst_site, 9u);
  EXPECT_NEAR(diff().worst_area, 0.99, 0.01);
  cells.area[9] *= 1 + 0.05e-5;
  EXPECT_EQ(diff().areas, 1u);
  EXPECT_GT(diff().worst_area, 1);
  cells = rightCells();
  const double mean = 1.0 / static_cast<double>(cells.report.ok);
  cells.area[202] = 0.9e-9 * mean;
  EXPECT_TRUE(diff().agree());
  cells.area[202] = 1.2e-9 * mean;
  EXPECT_FALSE(diff().agree());
  cells.area[202] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(diff().agree());
  EXPECT_EQ(diff().worst_site, 202u);
}

TEST_F(DiffCells, KeepsTheFirstTen) {
  for (double& area : cells.area) area *= 2;
  EXPECT_EQ(diff().areas, 202u - 1);
  ASSERT_EQ(diff().first.size(), 10u);
  EXPECT_EQ(diff().first[9].site, 9u);
}

TEST_F(DiffCells, RefusesCellsOfOtherSites) { EXPECT_FALSE(diffCells(cells, Diagram{})); }

}  // namespace
}  // namespace vorpipe::test
