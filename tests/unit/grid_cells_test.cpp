/// The cells of the float tier, found side by side in vector registers, against the same text compiled for
/// one cell at a time.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "backend/cpu/clipper.h"
#include "backend/cpu/grid_cells.h"
#include "backend/cpu/grid_lanes.h"
#include "core/prepare.h"

namespace vorpipe::cpu {

void findIn4Lanes(const LaneJob& job, bool roomy);

namespace {

/// What the backend gives to the walk.
constexpr int most_tried[2] = {256, 1024};

template <std::size_t Edges>
struct OneByOne {
  using Clip = Clipper<float, Edges>;
  using vec2 = typename Clip::vec2;
  using vec4 = typename Clip::vec4;

  static vec4 seenFrom(const Box& box, double x, double y) {
    return vec4(static_cast<float>(box.xmin - x), static_cast<float>(box.ymin - y),
                static_cast<float>(box.xmax - x), static_cast<float>(box.ymax - y));
  }

  CellStatus find(const SiteSet& set, std::uint32_t site, vec2 outset, std::vector<std::int32_t>& neighbors) {
    clip.sites = &set;
    clip.site_x = set.x[site];
    clip.site_y = set.y[site];
    const double x = std::clamp(clip.site_x, set.domain.xmin, set.domain.xmax);
    const double y = std::clamp(clip.site_y, set.domain.ymin, set.domain.ymax);
    typename Clip::Bins bins;
    bins.columns = static_cast<int>(set.grid.columns);
    bins.rows = static_cast<int>(set.grid.rows);
    bins.size = static_cast<float>(set.grid.size);
    bins.low = vec2(static_cast<float>(set.grid.xmin - x), static_cast<float>(set.grid.ymin - y));
    const float extent = std::max({std::abs(bins.low.x), std::abs(bins.low.y),
                                   std::abs(bins.low.x + static_cast<float>(bins.columns) * bins.size),
                                   std::abs(bins.low.y + static_cast<float>(bins.rows) * bins.size)});
    bins.slack = 4.8e-7F * extent;
    bins.known = seenFrom(set.known, x, y);
    bins.most = most_tried[Edges > EDGES_FAST ? 1 : 0];
    typename Clip::Cell cell;
    const vec2 shift(static_cast<float>(clip.site_x - x), static_cast<float>(clip.site_y - y));
    const auto status = static_cast<CellStatus>(
        clip.clipSite(cell, bins, seenFrom(set.domain, x, y), outset, static_cast<int>(site), shift));
    typename Clip::Order order;
    clip.orderEdges(cell, order);
    neighbors.assign(static_cast<std::size_t>(order.count), 0);
    for (std::size_t k = 0; k < Edges; ++k) {
      if (order.rank[k] >= 0) neighbors[static_cast<std::size_t>(order.rank[k])] = cell.line[k];
    }
    if (status != CellStatus::certified) neighbors.clear();
    return status;
  }

  Clip clip;
};

template <std::size_t Edges>
void compare(const SiteSet& set, Effort effort) {
  std::vector<std::uint32_t> all(set.size());
  std::iota(all.begin(), all.end(), 0U);
  Neighborhoods found;
  findOnGrid(set, all, effort, 2, found);
  std::vector<CellStatus> widened(set.size());
  statusesOnGrid(set, all, effort, 1e-3F, 2e-3F, 2, widened);
  OneByOne<Edges> one;
  std::vector<std::int32_t> neighbors;
  std::vector<std::int32_t> ignored;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    ASSERT_EQ(found.status[i], one.find(set, i, {0, 0}, neighbors)) << "site " << i;
    const std::vector<std::int32_t> here(
        found.neighbor.begin() + static_cast<std::ptrdiff_t>(found.first[i]),
        found.neighbor.begin() + static_cast<std::ptrdiff_t>(found.first[i + 1]));
    ASSERT_EQ(here, neighbors) << "site " << i;
    ASSERT_EQ(widened[i], one.find(set, i, {1e-3F, 2e-3F}, ignored)) << "site " << i << ", widened";
  }
}

void compareBoth(const Sites& sites, const Box& domain = {0, 0, 1, 1}) {
  auto prepared = prepare(sites, domain, 2);
  ASSERT_TRUE(prepared);
  compare<EDGES_FAST>(prepared->set, Effort::fast);
  compare<EDGES_MOST>(prepared->set, Effort::roomy);
  prepared->set.known = {0.25, 0.25, 0.75, 0.5};
  compare<EDGES_FAST>(prepared->set, Effort::fast);
}

TEST(GridCells, areTheSameSideBySideAsOneByOne) {
  for (const auto pattern : {Pattern::random, Pattern::square, Pattern::hex, Pattern::jitter,
                             Pattern::clusters, Pattern::circle}) {
    SCOPED_TRACE(static_cast<int>(pattern));
    compareBoth(generate(pattern, 3000, 7));
  }
  for (const std::uint64_t count : {1U, 2U, 5U, 17U}) compareBoth(generate(Pattern::random, count, 3));
  SCOPED_TRACE("outside");
  compareBoth(generate(Pattern::random, 3000, 5), {0.4, 0.3, 0.7, 0.5});
}

TEST(GridCells, areTheSameForAnyWidth) {
  const auto prepared = prepare(generate(Pattern::random, 5003, 11), {0, 0, 1, 1}, 2);
  ASSERT_TRUE(prepared);
  const auto& set = prepared->set;
  std::vector<std::uint32_t> all(set.size());
  std::iota(all.begin(), all.end(), 0U);
  const auto run = [&](FindInLanes find) {
    std::vector<std::uint8_t> status(set.size());
    std::vector<std::uint8_t> counts(set.size());
    std::vector<std::int32_t> neighbors(set.size() * EDGES_FAST, 0);
    LaneJob job{};
    job.x = set.x.data();
    job.y = set.y.data();
    job.first = set.grid.first.data();
    job.grid_xmin = set.grid.xmin;
    job.grid_ymin = set.grid.ymin;
    job.size = set.grid.size;
    job.columns = static_cast<int>(set.grid.columns);
    job.rows = static_cast<int>(set.grid.rows);
    for (const std::size_t side : {0U, 1U}) {
      job.domain[side] = 0;
      job.domain[side + 2] = 1;
      job.known[side] = -9;
      job.known[side + 2] = 9;
    }
    job.most = 256;
    job.which = all.data();
    job.count = all.size();
    job.status = status.data();
    job.neighbors = neighbors.data();
    job.neighbor_counts = counts.data();
    find(job, false);
    return std::tuple{status, counts, neighbors};
  };
  EXPECT_EQ(run(findIn4Lanes), run(findInLanes()));
}

}  // namespace
}  // namespace vorpipe::cpu
