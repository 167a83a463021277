/// The cells of the float tier, found side by side in vector registers, against the same text compiled for
/// one cell at a time.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <tuple>

#include "backend/cpu/clipper.h"
#include "backend/cpu/grid_cells.h"
#include "backend/cpu/grid_lanes.h"
#include "sites/site_set.h"
#include "sites/weights.h"

namespace vorpipe::cpu {

using namespace core;

void findIn4Lanes(const LaneJob& job, bool large);
void findWeightedIn4Lanes(const LaneJob& job, bool large);

namespace {

/// What the backend gives to the walk.
constexpr int most_tried[2] = {256, 1024};

/// The same text for sites with weights.
template <std::size_t Room>
struct WeightedClipper {
  using real = float;
  using vec2 = Vec2<real>;
  using vec4 = Vec4<real>;
  static constexpr int MAX_EDGES = static_cast<int>(Room);

  const SiteSet* sites = nullptr;
  double site_x = 0, site_y = 0, weight = 0;

  static constexpr int edgeEnd() { return MAX_EDGES; }
  [[nodiscard]] int firstOfBin(int bin) const {
    return static_cast<int>(sites->grid.offsets[static_cast<std::size_t>(bin)]);
  }
  [[nodiscard]] vec2 offsetTo(int index) const {
    const auto i = static_cast<std::size_t>(index);
    return vec2(static_cast<real>(sites->x[i] - site_x), static_cast<real>(sites->y[i] - site_y));
  }
  static real weightDifference(double own, double other) {
    return static_cast<real>(std::clamp(own - other, -1e18, 1e18));
  }
  [[nodiscard]] real weightDifference(int index) const {
    return weightDifference(weight, sites->weight[static_cast<std::size_t>(index)]);
  }
  [[nodiscard]] real weightExcess(int number) const {
    const real heavier = -weightDifference(weight, sites->grid.heaviest[static_cast<std::size_t>(number)]);
    return heavier + std::abs(heavier) * 1.2e-7F;
  }
  [[nodiscard]] int heavyAt(int k) const {
    return static_cast<int>(sites->heavy[static_cast<std::size_t>(k)]);
  }

#define WEIGHTED
#include "cell.glsl"
#include "grid.glsl"
#undef WEIGHTED
};

template <class Clip>
struct OneByOne {
  static constexpr std::size_t Edges = Clip::MAX_EDGES;
  static constexpr bool is_weighted = std::is_same_v<Clip, WeightedClipper<Edges>>;
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
    bins.coverage = seenFrom(set.coverage, x, y);
    bins.most = most_tried[Edges > EDGES_FAST ? 1 : 0];
    if constexpr (is_weighted) {
      bins.heavy = static_cast<int>(set.heavy.size());
      clip.weight = set.weight[site];
    }
    typename Clip::Cell cell;
    const vec2 origin_offset(static_cast<float>(clip.site_x - x), static_cast<float>(clip.site_y - y));
    const auto status = static_cast<CellStatus>(
        clip.clipSite(cell, bins, seenFrom(set.domain, x, y), outset, static_cast<int>(site), origin_offset));
    typename Clip::Order order;
    clip.orderEdges(cell, order);
    clip.beginAtFirst(cell, order);
    neighbors.assign(static_cast<std::size_t>(order.count), 0);
    for (std::size_t k = 0; k < Edges; ++k) {
      if (order.rank[k] >= 0) neighbors[static_cast<std::size_t>(order.rank[k])] = cell.line[k];
    }
    if (status != CellStatus::certified) neighbors.clear();
    if constexpr (is_weighted) {
      if (status != CellStatus::empty) return status;
      neighbors.assign(cell.line, cell.line + Edges);
      neighbors.push_back(cell.last);
    }
    return status;
  }

  Clip clip;
};

template <class Clip>
void compare(const SiteSet& set, Capacity capacity) {
  std::vector<std::uint32_t> all(set.size());
  std::iota(all.begin(), all.end(), 0U);
  CellNeighbors found;
  findOnGrid(set, all, capacity, 2, found);
  std::vector<CellStatus> widened(set.size());
  statusesOnGrid(set, all, capacity, 1e-3F, 2e-3F, 2, widened);
  OneByOne<Clip> one;
  std::vector<std::int32_t> neighbors;
  std::vector<std::int32_t> ignored;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    ASSERT_EQ(found.status[i], one.find(set, i, {0, 0}, neighbors)) << "site " << i;
    const std::vector<std::int32_t> here(
        found.neighbor.begin() + static_cast<std::ptrdiff_t>(found.offsets[i]),
        found.neighbor.begin() + static_cast<std::ptrdiff_t>(found.offsets[i + 1]));
    ASSERT_EQ(here, neighbors) << "site " << i;
    ASSERT_EQ(widened[i], one.find(set, i, {1e-3F, 2e-3F}, ignored)) << "site " << i << ", widened";
  }
}

void compareEfforts(const Sites& sites, const Box& domain = {0, 0, 1, 1}) {
  auto prepared = prepare(sites, domain, 2);
  ASSERT_TRUE(prepared);
  compare<Clipper<float, EDGES_FAST>>(prepared->set, Capacity::small);
  compare<Clipper<float, EDGES_MOST>>(prepared->set, Capacity::large);
  prepared->set.coverage = {0.25, 0.25, 0.75, 0.5};
  compare<Clipper<float, EDGES_FAST>>(prepared->set, Capacity::small);
}

TEST(GridCells, areTheSameSideBySideAsOneByOne) {
  for (const auto pattern : {Pattern::random, Pattern::square, Pattern::hex, Pattern::jitter,
                             Pattern::clusters, Pattern::circle}) {
    SCOPED_TRACE(static_cast<int>(pattern));
    compareEfforts(generate(pattern, 1500, 7));
  }
  for (const std::uint64_t count : {1U, 2U, 5U, 17U}) compareEfforts(generate(Pattern::random, count, 3));
  SCOPED_TRACE("outside");
  compareEfforts(generate(Pattern::random, 3000, 5), {0.4, 0.3, 0.7, 0.5});
}

SiteSet weightedSet(std::size_t count, double most, std::size_t heavy) {
  auto set = prepare(generate(Pattern::random, count, 8), {0, 0, 1, 1}, 2)->set;
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform;
  for (std::size_t i = 0; i < count; ++i) {
    set.weight.push_back(most * uniform(random) / static_cast<double>(count));
  }
  for (std::uint32_t k = 0; k < heavy; ++k) {
    set.weight[11 * k] = (k == 7 ? 1.0 : 1e-2) * uniform(random) + 1e3 / static_cast<double>(count);
    set.heavy.push_back(11 * k);
  }
  std::sort(set.heavy.begin(), set.heavy.end(),
            [&](auto a, auto b) { return set.weight[a] > set.weight[b]; });
  noteHeaviest(set, 1);
  buildPyramid(set.grid);
  return set;
}

TEST(GridCells, areTheSameSideBySideAsOneByOneWithWeights) {
  for (const double most : {0.1, 1.0, 10.0, 100.0}) {
    for (const std::size_t heavy : {0U, 1U, 10U, 32U}) {
      SCOPED_TRACE(most);
      SCOPED_TRACE(heavy);
      auto set = weightedSet(1500, most, heavy);
      compare<WeightedClipper<EDGES_FAST>>(set, Capacity::small);
      compare<WeightedClipper<EDGES_MOST>>(set, Capacity::large);
      set.coverage = {0.25, 0.25, 0.75, 0.5};
      compare<WeightedClipper<EDGES_FAST>>(set, Capacity::small);
    }
  }
}

auto runLanes(FindInLanes find, const SiteSet& set) {
  std::vector<std::uint32_t> all(set.size());
  std::iota(all.begin(), all.end(), 0U);
  std::vector<std::uint8_t> status(set.size());
  std::vector<std::uint8_t> counts(set.size());
  std::vector<std::int32_t> neighbors(set.size() * (EDGES_FAST + 1), 0);
  LaneJob job{};
  job.x = set.x.data();
  job.y = set.y.data();
  job.offsets = set.grid.offsets.data();
  job.grid_xmin = set.grid.xmin;
  job.grid_ymin = set.grid.ymin;
  job.size = set.grid.size;
  job.columns = static_cast<int>(set.grid.columns);
  job.rows = static_cast<int>(set.grid.rows);
  for (const std::size_t side : {0U, 1U}) {
    job.domain[side] = 0;
    job.domain[side + 2] = 1;
    job.coverage[side] = -9;
    job.coverage[side + 2] = 9;
  }
  job.most = 256;
  job.which = all.data();
  job.count = all.size();
  job.status = status.data();
  job.neighbors = neighbors.data();
  job.neighbor_counts = counts.data();
  job.weight = set.weight.data();
  job.heaviest = set.grid.heaviest.data();
  job.heavy = set.heavy.data();
  job.heavy_count = static_cast<int>(set.heavy.size());
  find(job, false);
  return std::tuple{status, counts, neighbors};
}

TEST(GridCells, areTheSameForAnyWidth) {
  const auto prepared = prepare(generate(Pattern::random, 5003, 11), {0, 0, 1, 1}, 2);
  ASSERT_TRUE(prepared);
  EXPECT_EQ(runLanes(findIn4Lanes, prepared->set), runLanes(findInLanes(false), prepared->set));
  const auto weighted = weightedSet(5003, 3, 5);
  EXPECT_EQ(runLanes(findWeightedIn4Lanes, weighted), runLanes(findInLanes(true), weighted));
}

}  // namespace
}  // namespace vorpipe::cpu
