#include "cells/neighbor_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace vorpipe::test {

using namespace core;

namespace {

using enum CellStatus;
using testing::ElementsAre;
using testing::IsEmpty;

using Indices = std::vector<std::uint32_t>;

TEST(NeighborRows, PutLaterAnswersInThePlaceOfEarlierOnes) {
  NeighborRows cells(4, 2);
  cells.add(Indices{2, 0}, CellNeighbors{{certified, overflow}, {0, 3, 3}, {-2, 0, -1}});
  cells.add(Indices{0, 3}, CellNeighbors{{certified, empty}, {0, 2, 2}, {-4, 2}});
  EXPECT_EQ(cells.status(0), certified);
  EXPECT_EQ(cells.status(1), missing);
  EXPECT_EQ(cells.status(2), certified);
  EXPECT_EQ(cells.status(3), empty);
  EXPECT_THAT(cells.edges(0), ElementsAre(-4, 2));
  EXPECT_THAT(cells.edges(1), IsEmpty());
  EXPECT_THAT(cells.edges(2), ElementsAre(-2, 0, -1));
  EXPECT_THAT(cells.edges(3), IsEmpty());
}

/// The entries begin, begin + step, ... of `count`: entry e has e % 5 neighbors, all of them e.
CellNeighbors everySome(std::uint32_t begin, std::uint32_t count, std::uint32_t step, Indices& which) {
  CellNeighbors found{{}, {0}, {}};
  for (auto cell = begin; cell < count; cell += step) {
    which.push_back(cell);
    found.status.push_back(certified);
    for (std::uint32_t k = 0; k < cell % 5; ++k) found.neighbor.push_back(static_cast<std::int32_t>(cell));
    found.offsets.push_back(found.neighbor.size());
  }
  return found;
}

void expectEverySome(const NeighborRows& cells, std::uint32_t cell) {
  ASSERT_EQ(cells.edges(cell).size(), cell % 5);
  for (const auto neighbor : cells.edges(cell)) ASSERT_EQ(neighbor, static_cast<std::int32_t>(cell));
}

TEST(NeighborRows, AreMany) {
  constexpr std::uint32_t count = 200000;
  NeighborRows cells(count, 3);
  for (std::uint32_t odd = 0; odd < 2; ++odd) {
    Indices which;
    auto found = everySome(odd, count, 2, which);
    cells.add(which, std::move(found));
  }
  ASSERT_EQ(cells.size(), count);
  for (std::uint32_t cell = 0; cell < count; ++cell) expectEverySome(cells, cell);
}

TEST(NeighborRows, MoveFromOtherCellRows) {
  constexpr std::uint32_t count = 1000;
  NeighborRows cells(count, 2);
  Indices which, entries(count / 2);
  auto found = everySome(1, count, 2, which);
  std::iota(entries.begin(), entries.end(), 0u);
  {
    NeighborRows some(which.size(), 2);
    some.add(entries, std::move(found));
    cells.add(which, std::move(some));
  }
  for (std::uint32_t cell = 0; cell < count; ++cell) {
    EXPECT_EQ(cells.status(cell), cell % 2 == 1 ? certified : missing);
    if (cell % 2 == 1) expectEverySome(cells, cell);
  }
}

TEST(NeighborRows, CanBeReadBeyondTheirEnd) {
  // Under a sanitizer, that no row is too near to the end of its memory.
  for (std::uint32_t count = 1; count < 12; ++count) {
    NeighborRows cells(count, 1);
    Indices which;
    auto found = everySome(0, count, 1, which);
    cells.add(which, std::move(found));
    for (std::uint32_t cell = 0; cell < count; ++cell) {
      expectEverySome(cells, cell);
      const auto* edges = cells.edges(cell).data();
      EXPECT_NE(std::accumulate(edges, edges + NeighborRows::readable, std::int64_t{0}), -1);
    }
  }
}

TEST(NeighborRows, RememberLargeCells) {
  NeighborRows cells(5, 2);
  CellNeighbors found{{certified, certified, certified}, {0}, {}};
  for (const std::size_t edges :
       {NeighborRows::usual_edges + 1, NeighborRows::usual_edges, NeighborRows::usual_edges + 9}) {
    found.neighbor.resize(found.neighbor.size() + edges, 0);
    found.offsets.push_back(found.neighbor.size());
  }
  cells.add(Indices{4, 3, 1}, std::move(found));
  EXPECT_THAT(cells.large(), ElementsAre(1, 4));
  cells.drop(4, empty);
  EXPECT_THAT(cells.large(), ElementsAre(1));
  EXPECT_THAT(cells.edges(4), IsEmpty());
  EXPECT_EQ(cells.status(4), empty);
}

}  // namespace
}  // namespace vorpipe::test
