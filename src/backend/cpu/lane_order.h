/// Groups cells with equally many candidates into one vector: a vector takes as long as its slowest lane.
/// See lane_words.h.
#pragma once

#include "backend/cpu/lane_job.h"
#include "backend/cpu/lane_words.h"

namespace vorpipe::cpu {
namespace {
namespace lanes {

/// Some of the cells of a job, in processing order.
struct LaneOrder {
  static constexpr std::size_t most = 1024;
  static constexpr int most_around = 63;

  std::uint32_t cell[most];  ///< indices into the job's cells

  /// Sorts the cells begin .. begin + count - 1 by the number of sites in the bins around each.
  void sort(const LaneJob& job, std::size_t begin, std::size_t count) {
    std::uint32_t next[most_around + 2] = {};
    std::uint8_t around[most];
    for (std::size_t k = 0; k < count; ++k) {
      around[k] = static_cast<std::uint8_t>(sitesAround(job, job.which[begin + k]));
      ++next[around[k] + 1];
    }
    for (int n = 0; n < most_around; ++n) next[n + 1] += next[n];
    for (std::size_t k = 0; k < count; ++k) {
      cell[next[around[k]]++] = static_cast<std::uint32_t>(begin + k);
    }
  }

 private:
  /// Prefetches sites of the row beyond: cells come by rows of bins and use these sites for the first time.
  /// (Always inlined: otherwise GCC sees no effect and drops the call.)
  [[gnu::always_inline]] static void prefetch(const LaneJob& job, std::uint32_t site) {
    __builtin_prefetch(job.x + site);
    __builtin_prefetch(job.y + site);
  }

  static int binAlong(double at, double size, int count) {
    return static_cast<int>(max(0.0, min(at / size, static_cast<double>(count - 1))));
  }

  static int sitesAround(const LaneJob& job, std::uint32_t site) {
    const int column = binAlong(job.x[site] - job.grid_xmin, job.size, job.columns);
    const int row = binAlong(job.y[site] - job.grid_ymin, job.size, job.rows);
    const int west = max(column - 1, 0);
    const int east = min(column + 1, job.columns - 1);
    std::uint32_t sum = 0;
    for (int r = max(row - 1, 0); r <= min(row + 1, job.rows - 1); ++r) {
      const auto first = job.offsets[r * job.columns + west];
      sum += job.offsets[r * job.columns + east + 1] - first;
      if (r > row) prefetch(job, first);
    }
    return static_cast<int>(sum < most_around ? sum : most_around);
  }
};

}  // namespace lanes
}  // namespace
}  // namespace vorpipe::cpu
