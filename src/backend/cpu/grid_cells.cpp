#include "backend/cpu/grid_cells.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "backend/cpu/grid_lanes.h"
#include "base/parallel.h"
#include "layout.glsl"

namespace vorpipe::cpu {
namespace {

/// Sites to try before the search gives up: where a cell needs more, the tree finds them faster.
constexpr int most_tried_fast = 256;
constexpr int most_tried_roomy = 1024;
constexpr std::size_t most_at_once = 2048;

/// The job of finding the cells from `begin` up to `end`, without a place for neighbors.
LaneJob jobOf(const SiteSet& sites, std::span<const std::uint32_t> which, Capacity capacity,
              std::size_t begin, std::size_t end, std::span<CellStatus> status) {
  static_assert(sizeof(CellStatus) == sizeof(std::uint8_t));
  const auto& grid = sites.grid;
  const auto& domain = sites.domain;
  const auto& coverage = sites.coverage;
  return {.x = sites.x.data(),
          .y = sites.y.data(),
          .offsets = grid.offsets.data(),
          .grid_xmin = grid.xmin,
          .grid_ymin = grid.ymin,
          .size = grid.size,
          .columns = static_cast<int>(grid.columns),
          .rows = static_cast<int>(grid.rows),
          .domain = {domain.xmin, domain.ymin, domain.xmax, domain.ymax},
          .coverage = {coverage.xmin, coverage.ymin, coverage.xmax, coverage.ymax},
          .outset_x = 0,
          .outset_y = 0,
          .most = capacity == Capacity::small ? most_tried_fast : most_tried_roomy,
          .which = which.data() + begin,
          .count = end - begin,
          .status = reinterpret_cast<std::uint8_t*>(status.data() + begin),
          .neighbors = nullptr,
          .neighbor_counts = nullptr,
          .weight = sites.weight.data(),
          .heaviest = grid.heaviest.data(),
          .heavy = sites.heavy.data(),
          .heavy_count = static_cast<int>(sites.heavy.size())};
}

}  // namespace

void findOnGrid(const SiteSet& sites, std::span<const std::uint32_t> which, Capacity capacity, int threads,
                CellNeighbors& out) {
  const bool large = capacity == Capacity::large;
  const bool weighted = !sites.weight.empty();
  const std::size_t edges = large ? EDGES_MOST : EDGES_FAST;
  const auto room = edges + (weighted ? 1 : 0);
  const auto find = findInLanes(weighted);
  const auto count = which.size();
  // Not a vector, which would fill it first: it is written before it is read.
  const auto neighbors = std::make_unique_for_overwrite<std::int32_t[]>(count * room);
  const auto counts = std::make_unique_for_overwrite<std::uint8_t[]>(count);
  out.status.resize(count);
  out.offsets.resize(count + 1);
  const auto grain = grainFor(count, most_at_once);
  std::vector<std::uint64_t> offset((count + grain - 1) / grain + 1, 0);
  parallelFor(count, grain, threads, [&](std::size_t begin, std::size_t end) {
    auto job = jobOf(sites, which, capacity, begin, end, out.status);
    job.neighbors = neighbors.get() + begin * room;
    job.neighbor_counts = counts.get() + begin;
    find(job, large);
    std::uint64_t sum = 0;
    for (auto e = begin; e < end; ++e) {
      out.offsets[e] = sum;
      sum += counts[e];
    }
    offset[begin / grain + 1] = sum;
  });
  for (std::size_t r = 1; r < offset.size(); ++r) offset[r] += offset[r - 1];
  out.offsets[count] = offset.back();
  out.neighbor.resize(offset.back());
  parallelFor(count, grain, threadsForSteps(count, threads), [&](std::size_t begin, std::size_t end) {
    for (auto e = begin; e < end; ++e) {
      out.offsets[e] += offset[begin / grain];
      std::copy_n(neighbors.get() + e * room, counts[e], out.neighbor.data() + out.offsets[e]);
    }
  });
}

void statusesOnGrid(const SiteSet& sites, std::span<const std::uint32_t> which, Capacity capacity,
                    float outset_x, float outset_y, int threads, std::span<CellStatus> status) {
  const auto find = findInLanes(!sites.weight.empty());
  parallelFor(which.size(), grainFor(which.size(), most_at_once), threads,
              [&](std::size_t begin, std::size_t end) {
                auto job = jobOf(sites, which, capacity, begin, end, status);
                job.outset_x = outset_x;
                job.outset_y = outset_y;
                find(job, capacity == Capacity::large);
              });
}

}  // namespace vorpipe::cpu
