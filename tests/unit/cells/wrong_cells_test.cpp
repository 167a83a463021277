/// Cells that do not agree.
#include <gtest/gtest.h>

#include "unit/cells/agreed_cells.h"

namespace vorpipe::test {
namespace {

class WrongCells : public testing::Test {
 protected:
  void expectDisputed(const Rows& wrong, std::initializer_list<std::int32_t> culprits) {
    for (const int threads : {1, 4}) {
      const auto result = assemble(set, cellsOf(wrong), threads);
      for (const auto i : culprits) {
        EXPECT_TRUE(std::binary_search(result.disputed.begin(), result.disputed.end(), i)) << i;
      }
      EXPECT_LE(result.disputed.size(), 16u);
    }
  }
  /// A cell without walls, in the middle.
  static constexpr std::int32_t cell = 78;
  const SiteSet set = jitteredSites(12, 0.4);
  const Rows rows = rowsOf(set);
};

TEST_F(WrongCells, thatMissANeighborAreDisputed) {
  for (std::size_t e = 0; e < rows[cell].size(); ++e) {
    auto wrong = rows;
    wrong[cell].erase(wrong[cell].begin() + static_cast<std::ptrdiff_t>(e));
    expectDisputed(wrong, {cell, rows[cell][e]});
  }
}

TEST_F(WrongCells, thatSwapNeighborsAreDisputed) {
  for (std::size_t e = 0; e < rows[cell].size(); ++e) {
    auto wrong = rows;
    std::swap(wrong[cell][e], wrong[cell][(e + 1) % rows[cell].size()]);
    expectDisputed(wrong, {cell});
  }
}

TEST_F(WrongCells, thatRunClockwiseAreDisputed) {
  auto wrong = rows;
  std::reverse(wrong[cell].begin(), wrong[cell].end());
  expectDisputed(wrong, {cell});
}

/// All four cells agree on the diagonal that is not Delaunay.
TEST_F(WrongCells, aroundAFlippedDiagonalAreDisputed) {
  const auto remove = [](auto& row, std::int32_t n) { row.erase(std::find(row.begin(), row.end(), n)); };
  const auto insertBefore = [](auto& row, std::int32_t next, std::int32_t n) {
    row.insert(std::find(row.begin(), row.end(), next), n);
  };
  for (std::size_t e = 0; e < rows[cell].size(); ++e) {
    const auto size = rows[cell].size();
    const auto p = rows[cell][(e + size - 1) % size], other = rows[cell][e], q = rows[cell][(e + 1) % size];
    auto wrong = rows;
    remove(wrong[cell], other);
    remove(wrong[static_cast<std::size_t>(other)], cell);
    // Counter-clockwise, p sees the other before the cell, and q the cell before the other.
    insertBefore(wrong[static_cast<std::size_t>(p)], cell, q);
    insertBefore(wrong[static_cast<std::size_t>(q)], other, p);
    expectDisputed(wrong, {cell});
  }
}

TEST_F(WrongCells, thatAreNoCellsAreDisputed) {
  for (const auto& row : {std::vector<std::int32_t>{},
                          {wall_xmin, wall_xmax},
                          {wall_xmin, cell, wall_xmax},
                          {wall_xmin, 1000, wall_ymax},
                          {wall_xmin, -5, wall_ymax}}) {
    auto wrong = rows;
    wrong[cell] = row;
    expectDisputed(wrong, {cell});
  }
  auto cells = cellsOf(rows);
  cells.status[cell] = CellStatus::missing;
  const auto disputed = assemble(set, cells).disputed;
  EXPECT_TRUE(std::binary_search(disputed.begin(), disputed.end(), cell));
}

TEST_F(WrongCells, withAWallInTheMiddleAreDisputed) {
  auto wrong = rows;
  wrong[cell][0] = wall_ymin;
  expectDisputed(wrong, {cell, rows[cell][0]});
}

}  // namespace
}  // namespace vorpipe::test
