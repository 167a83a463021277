#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vorpipe {
namespace {

using Ranges = std::set<std::pair<std::size_t, std::size_t>>;

Ranges rangesOf(std::size_t count, std::size_t grain, int threads) {
  Ranges ranges;
  std::mutex mutex;
  parallelFor(count, grain, threads, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard lock(mutex);
    EXPECT_TRUE(ranges.emplace(begin, end).second);
  });
  return ranges;
}

TEST(Parallel, RangesDoNotDependOnTheThreads) {
  const Ranges ranges = {{0, 3}, {3, 6}, {6, 9}, {9, 10}};
  for (const int threads : {0, 1, 2, 3, 64}) EXPECT_EQ(rangesOf(10, 3, threads), ranges) << threads;
  EXPECT_EQ(rangesOf(10, 100, 4), (Ranges{{0, 10}}));
  EXPECT_EQ(rangesOf(0, 3, 4), Ranges{});
}

TEST(Parallel, EveryStepIsDoneOnceInLoopsWithinALoop) {
  constexpr std::size_t rows = 50, columns = 1000;
  std::vector<std::atomic<int>> done(rows * columns);
  parallelFor(rows, 1, 8, [&](std::size_t row, std::size_t) {
    parallelFor(columns, 7, 3, [&](std::size_t begin, std::size_t end) {
      for (auto column = begin; column < end; ++column) ++done[row * columns + column];
    });
  });
  for (const auto& times : done) ASSERT_EQ(times, 1);
}

TEST(Parallel, WhatALoopThrowsArrivesOnceAllHaveStopped) {
  for (const int threads : {1, 2, 16}) {
    std::atomic<int> inside{0};
    const auto loop = [&] {
      parallelFor(10000, 1, threads, [&](std::size_t begin, std::size_t) {
        ++inside;
        if (begin == 77) {
          --inside;
          throw std::runtime_error("77");
        }
        --inside;
      });
    };
    EXPECT_THROW(loop(), std::runtime_error);
    EXPECT_EQ(inside, 0);
  }
}

}  // namespace
}  // namespace vorpipe
