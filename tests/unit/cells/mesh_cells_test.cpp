/// What the cells of the mesh are for: they agree, in every tie, and no device wastes time on their sites.
/// judge_test compares them with brute force.
#include "cells/site_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "backend/registry/registry.h"
#include "cells/neighbor_search.h"
#include "geometry/curve_order.h"
#include "sites/site_set.h"
#include "unit/fixtures/all_of.h"
#include "unit/fixtures/changed_cpu.h"
#include "unit/fixtures/mesh_rows.h"
#include "unit/fixtures/proposed_cells.h"

namespace vorpipe::test {

using namespace core;

namespace {

SiteSet prepared(Sites sites, const Box& domain = {0, 0, 1, 1}) { return prepare(sites, domain, 2)->set; }

CellNeighbors cellsFromMesh(const SiteSet& sites, int threads = 2) {
  SiteMesh mesh(sites, threads);
  return rowsFromMesh(sites, *mesh.get(), allOf(sites), threads);
}

TEST(MeshCells, AgreeWithoutADispute) {
  const Box whole{0, 0, 1, 1}, at_bisectors{0.25, 0.5, 0.75, 1};
  for (const auto& sites :
       {prepared(generate(Pattern::circle, 20000, 1)), prepared(generate(Pattern::random, 5000, 1)),
        prepared(generate(Pattern::random, 5000, 1), {0.4, 0.4, 0.6, 0.6}),
        prepared(generate(Pattern::square, 4096, 1), whole),
        prepared(generate(Pattern::square, 4096, 1), at_bisectors),
        prepared(generate(Pattern::hex, 4000, 1))}) {
    const auto result = assemble(sites, cellsFromMesh(sites));
    EXPECT_TRUE(result.disputed.empty()) << result.disputed.size() << " of " << sites.size();
    const double area = std::accumulate(result.diagram.area.begin(), result.diagram.area.end(), 0.0);
    const auto& d = sites.domain;
    EXPECT_NEAR(area / ((d.xmax - d.xmin) * (d.ymax - d.ymin)), 1, 1e-9);
  }
}

TEST(MeshCells, AreTheSameForAnyNumberOfThreads) {
  const auto sites = prepared(generate(Pattern::clusters, 30000, 1));
  const auto one = cellsFromMesh(sites, 1), many = cellsFromMesh(sites, 5);
  EXPECT_EQ(one.neighbor, many.neighbor);
  EXPECT_EQ(one.offsets, many.offsets);
}

TEST(MeshCells, OfSitesThatTheMeshHasNoDecisionsFor) {
  const auto row = prepared({{0.1, 0.2, 0.5}, {0.5, 0.5, 0.5}, {}});
  EXPECT_EQ(SiteMesh(row, 1).get(), nullptr);
  const auto near_and_far = prepared({{1e-60, 0.2, 0.5, -1e80}, {0.5, 0.1, 0.7, 1e70}, {}});
  EXPECT_EQ(SiteMesh(near_and_far, 1).get(), nullptr);
  const auto far = prepared({{1e80, 0.2, 0.5, -1e80}, {0.5, 0.1, 0.7, 1e70}, {}});
  SiteMesh mesh(far, 1);
  ASSERT_NE(mesh.get(), nullptr);
  const auto cells = rowsFromMesh(far, *mesh.get(), allOf(far), 1);
  EXPECT_EQ(std::count(cells.status.begin(), cells.status.end(), CellStatus::certified), 2);
}

/// Rows of all cells of a set, but for those that are left.
NeighborRows knownRows(const SiteSet& sites, const CellNeighbors& all,
                       const std::vector<std::uint8_t>& is_left) {
  NeighborRows rows(sites.size(), 2);
  std::vector<std::uint32_t> which;
  CellNeighbors known;
  known.offsets.push_back(0);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (is_left[i] != 0) continue;
    which.push_back(i);
    known.status.push_back(all.status[i]);
    known.neighbor.insert(known.neighbor.end(),
                          all.neighbor.begin() + static_cast<std::ptrdiff_t>(all.offsets[i]),
                          all.neighbor.begin() + static_cast<std::ptrdiff_t>(all.offsets[i + 1]));
    known.offsets.push_back(known.neighbor.size());
  }
  rows.add(which, std::move(known));
  return rows;
}

/// From the triangulation of these sites and of those beside them: the same cells, in every tie.
TEST(MeshCells, OfSomeSitesAreThoseOfAll) {
  for (const auto& sites :
       {prepared(generate(Pattern::random, 5000, 1)), prepared(generate(Pattern::clusters, 5000, 1)),
        prepared(generate(Pattern::square, 4096, 1)), prepared(generate(Pattern::circle, 2000, 1)),
        prepared(generate(Pattern::random, 5000, 1), {0.4, 0.4, 0.6, 0.6})}) {
    const auto all = cellsFromMesh(sites);
    const auto exact = openExactTier(0);
    for (const std::uint32_t every : {2u, 7u, 500u}) {
      std::vector<std::uint32_t> left;
      std::vector<std::uint8_t> is_left(sites.size());
      // Single ones, and runs of neighbors.
      for (std::uint32_t i = 0; i < sites.size(); ++i) {
        is_left[i] = i % every == 0 || i % 1000 < 100;
        if (is_left[i] != 0) left.push_back(i);
      }
      SiteMesh mesh(sites, 2);
      ExactSearch exact_search(*exact, mesh);
      auto rows = knownRows(sites, all, is_left);
      ASSERT_TRUE(exact_search.findAmong(left, 2, rows));
      EXPECT_FALSE(mesh.isMade());
      for (std::size_t i = 0; i < sites.size(); ++i) {
        ASSERT_EQ(rows.status(i), all.status[i]) << "site " << i;
        const auto row = std::span(all.neighbor).subspan(all.offsets[i], all.offsets[i + 1] - all.offsets[i]);
        ASSERT_TRUE(std::ranges::equal(rows.edges(i), row)) << "site " << i;
      }
    }
  }
}

/// Sites of which few bits differ are sorted along a curve of their own.
TEST(CurveOrder, HasNearSitesNearEachOther) {
  auto sites = generate(Pattern::random, 4000, 1);
  for (std::size_t i = 0; i < 3000; ++i) {
    sites.x[i] = 0.5 + std::ldexp(sites.x[i], -40);
    sites.y[i] = 0.5 + std::ldexp(sites.y[i], -40);
  }
  const auto set = prepared(sites);
  const auto lengthAlong = [&](const std::vector<std::uint32_t>& order) {
    double length = 0;
    for (std::size_t k = 1; k < order.size(); ++k) {
      const double way =
          std::hypot(set.x[order[k]] - set.x[order[k - 1]], set.y[order[k]] - set.y[order[k - 1]]);
      length += way < 0x1p-38 ? std::ldexp(way, 40) : 0;
    }
    return length;
  };
  auto order = allOf(set), other = order;
  std::ranges::reverse(other);
  sortAlongCurve(set, order, 1);
  sortAlongCurve(set, other, 3);
  EXPECT_EQ(order, other) << "it follows from the sites alone";
  EXPECT_LT(lengthAlong(order), 2 * std::sqrt(3000.0));
}

/// Counts the cells that a device is asked for.
class CountingDevice final : public ChangedCpu {
 public:
  CountingDevice() : ChangedCpu(0) {}
  Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) override {
    asked += which.size();
    return ChangedCpu::cells(which, capacity, out);
  }

  std::size_t asked = 0;
};

/// Counts the cells that the exact tier is asked for.
class CountingTier final : public ExactTier {
 public:
  void take(const SiteSet& sites) override { real_->take(sites); }
  void cells(std::span<const std::uint32_t> which, Precision precision, CellNeighbors& out) override {
    asked += which.size();
    real_->cells(which, precision, out);
  }
  void nearest(const View& view, std::span<const std::uint32_t> pixels,
               std::span<std::uint32_t> sites) override {
    real_->nearest(view, pixels, sites);
  }

  std::size_t asked = 0;

 private:
  std::unique_ptr<ExactTier> real_ = openExactTier(0);
};

struct Asked {
  std::size_t device, exact;
};

Asked askedFor(Pattern pattern) {
  const auto sites = prepared(generate(pattern, 40000, 1));
  CountingDevice device;
  CountingTier exact;
  SiteMesh mesh(sites, 2);
  ExactSearch exact_search(exact, mesh);
  const SearchOptions search;
  const Progress progress;
  Report report;
  const auto rows =
      findNeighbors({device, exact_search, sites, search, 2, progress}, AtEmpty::ignore, report);
  EXPECT_TRUE(rows);
  for (std::size_t i = 0; i < sites.size(); ++i) EXPECT_NE((*rows)->status(i), CellStatus::missing);
  return {device.asked, exact.asked};
}

TEST(MeshCells, SpareTheDeviceAndTheExactTierWhatTheyFailAt) {
  const auto circle = askedFor(Pattern::circle);
  EXPECT_EQ(circle.device, 0u) << "all of it is crowded";
  EXPECT_EQ(circle.exact, 0u);
  const auto random = askedFor(Pattern::random);
  EXPECT_GE(random.device, 40000u);
  EXPECT_EQ(random.exact, 0u) << "what is left comes from the triangulation of it and of what is beside it";
}

}  // namespace
}  // namespace vorpipe::test
