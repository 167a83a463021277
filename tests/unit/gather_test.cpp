#include "core/gather.h"

#include <gtest/gtest.h>

#include <numeric>

namespace vorpipe::test {
namespace {

using enum CellStatus;

TEST(Gathering, PutsLaterAnswersInThePlaceOfEarlierOnes) {
  Gathering gathering(4, 2);
  gathering.add(std::vector<std::uint32_t>{2, 0}, {{certified, overflow}, {0, 3, 3}, {0, -1, -2}});
  gathering.add(std::vector<std::uint32_t>{0, 3}, {{certified, empty}, {0, 2, 2}, {2, -4}});
  const auto all = gathering.finish();
  EXPECT_EQ(all.status, (std::vector{certified, missing, certified, empty}));
  EXPECT_EQ(all.first, (BigVector<std::uint64_t>{0, 2, 2, 5, 5}));
  EXPECT_EQ(all.neighbor, (BigVector<std::int32_t>{2, -4, 0, -1, -2}));
}

TEST(Gathering, HoldsManyCells) {
  constexpr std::uint32_t count = 200000;
  Gathering gathering(count, 3);
  for (std::uint32_t odd = 0; odd < 2; ++odd) {
    std::vector<std::uint32_t> which;
    Neighborhoods found{{}, {0}, {}};
    for (auto cell = odd; cell < count; cell += 2) {
      which.push_back(cell);
      found.status.push_back(certified);
      for (std::uint32_t k = 0; k < cell % 5; ++k) found.neighbor.push_back(static_cast<std::int32_t>(cell));
      found.first.push_back(found.neighbor.size());
    }
    gathering.add(which, std::move(found));
  }
  const auto all = gathering.finish();
  ASSERT_EQ(all.status.size(), count);
  for (std::uint32_t cell = 0; cell < count; ++cell) {
    ASSERT_EQ(all.first[cell + 1] - all.first[cell], cell % 5);
    for (auto k = all.first[cell]; k < all.first[cell + 1]; ++k) {
      ASSERT_EQ(all.neighbor[k], static_cast<std::int32_t>(cell));
    }
  }
}

}  // namespace
}  // namespace vorpipe::test
