#include "picture/distinct_colors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <utility>

namespace vorpipe::test {

using namespace core;

namespace {

using Pairs = std::vector<std::pair<std::int64_t, std::int64_t>>;

/// Cells with these edges, of which some may be there twice, and with one wall each.
Diagram linkedCells(std::size_t count, const Pairs& edges) {
  std::vector<std::vector<std::int64_t>> neighbors(count, {-1});
  for (const auto& [a, b] : edges) {
    neighbors[static_cast<std::size_t>(a)].push_back(b);
    neighbors[static_cast<std::size_t>(b)].push_back(a);
  }
  Diagram cells;
  cells.status.assign(count, Status::ok);
  cells.cell_offsets.push_back(0);
  for (const auto& of_cell : neighbors) {
    cells.neighbors.insert(cells.neighbors.end(), of_cell.begin(), of_cell.end());
    cells.cell_offsets.push_back(cells.neighbors.size());
  }
  return cells;
}

std::size_t colorsOf(std::size_t count, const Pairs& edges) {
  const auto colors = distinctColors(linkedCells(count, edges), 7);
  EXPECT_TRUE(colors);
  for (const auto& [a, b] : edges) {
    if (a == b) continue;
    EXPECT_NE((*colors)[static_cast<std::size_t>(a)], (*colors)[static_cast<std::size_t>(b)])
        << a << ' ' << b;
  }
  return std::set<std::uint8_t>(colors->begin(), colors->end()).size();
}

TEST(DistinctColors, AreAsFewAsTheseCellsTake) {
  EXPECT_EQ(colorsOf(1, {}), 1u);
  EXPECT_EQ(colorsOf(2, {{0, 1}, {0, 1}, {1, 1}}), 2u) << "an edge twice, and a cell beside its own image";
  EXPECT_EQ(colorsOf(4, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}), 4u);
  // A chain, whatever the order of its cells.
  EXPECT_EQ(colorsOf(5, {{3, 0}, {0, 4}, {4, 1}, {1, 2}}), 2u);
}

/// Triangles, each split again and again at one place: many cells have three neighbors, some have hundreds.
TEST(DistinctColors, OfAPlaneAreAtMostSix) {
  std::mt19937 random(7);
  Pairs edges{{0, 1}, {1, 2}, {2, 0}};
  std::vector<std::array<std::int64_t, 3>> triangles{{0, 1, 2}, {0, 1, 2}};
  std::int64_t count = 3;
  for (; count < 3000; ++count) {
    auto& at = triangles[random() % triangles.size()];
    const auto [a, b, c] = at;
    for (const std::int64_t corner : {a, b, c}) edges.emplace_back(corner, count);
    at = {a, b, count};
    triangles.push_back({b, c, count});
    triangles.push_back({c, a, count});
  }
  EXPECT_LE(colorsOf(static_cast<std::size_t>(count), edges), 6u);
}

TEST(DistinctColors, TooFewAreRefused) {
  const auto colors = distinctColors(linkedCells(3, {{0, 1}, {1, 2}, {2, 0}}), 2);
  ASSERT_FALSE(colors);
  EXPECT_NE(colors.error().message.find("take 3, and there are 2"), std::string::npos)
      << colors.error().message;
}

}  // namespace
}  // namespace vorpipe::test
