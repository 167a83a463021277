#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "base/distinct.h"
#include "cells/device_ladder.h"

namespace vorpipe::test {

using namespace core;

namespace {

TEST(SortDistinct, SortsFewAndMany) {
  std::mt19937 random(17);
  for (const std::size_t count : {0u, 1u, 5u, 400u, 999u, 1000u}) {
    std::vector<std::uint32_t> numbers(1000);
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::shuffle(numbers.begin(), numbers.end(), random);
    numbers.resize(count);
    auto sorted = numbers;
    std::sort(sorted.begin(), sorted.end());
    sortDistinct(numbers, 1000);
    EXPECT_EQ(numbers, sorted) << count;
  }
}

TEST(Sample, IsHopelessWhereMoreThanThreeInFourFail) {
  std::vector<std::uint32_t> which(12800);
  std::iota(which.begin(), which.end(), 7u);
  const Sample sample(which);
  ASSERT_EQ(sample.cells.size(), 128u);
  EXPECT_EQ(sample.rest.size(), which.size() - 128);
  EXPECT_FALSE(sample.isHopeless(0));
  EXPECT_FALSE(sample.isHopeless(96));
  EXPECT_TRUE(sample.isHopeless(97));
}

}  // namespace
}  // namespace vorpipe::test
