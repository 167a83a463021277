/// Sets of sites for tests of the judge, and its cells compared with brute force in rational numbers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <set>

#include "backend/cpu/exact_cells.h"
#include "backend/cpu/tree_cells.h"
#include "cells/site_mesh.h"
#include "unit/fixtures/all_of.h"
#include "unit/fixtures/brute_force.h"
#include "unit/fixtures/mesh_rows.h"

namespace vorpipe::cpu {

using namespace core;
using test::allOf;

inline SiteSet setOf(const std::vector<Point>& points, const Box& domain = {0, 0, 1, 1}) {
  constexpr double far = std::numeric_limits<double>::infinity();
  SiteSet set;
  set.domain = domain;
  set.coverage = {-far, -far, far, far};
  std::set<std::pair<double, double>> seen;
  for (const auto& p : points) {
    if (!seen.insert({p.x, p.y}).second) continue;
    set.id.push_back(static_cast<std::uint32_t>(set.x.size()));
    set.x.push_back(p.x);
    set.y.push_back(p.y);
  }
  set.grid.offsets = {0, static_cast<std::uint32_t>(set.size())};
  return set;
}

using Finder =
    std::function<void(const SiteSet&, const SiteTree&, std::span<const std::uint32_t>, int, CellNeighbors&)>;

inline CellNeighbors find(const Finder& finder, const SiteSet& set, int threads = 2) {
  const SiteTree tree(set, threads);
  CellNeighbors out;
  finder(set, tree, allOf(set), threads, out);
  return out;
}

/// From the mesh; of sites that have none, exactly.
inline void findFromMesh(const SiteSet& set, const SiteTree& tree, std::span<const std::uint32_t> which,
                         int threads, CellNeighbors& out) {
  SiteMesh mesh(set, threads);
  if (const auto* made = mesh.get(); made != nullptr) {
    out = test::rowsFromMesh(set, *made, which, threads);
  } else {
    findExactly(set, tree, which, threads, out);
  }
}

/// Whether the neighbors stand counter-clockwise, as seen from the site.
inline bool isCounterclockwise(const SiteSet& set, std::uint32_t site,
                               std::span<const std::int32_t> neighbors) {
  int turns = 0;
  const auto direction = [&](std::int32_t n) -> Point {
    if (n >= 0) {
      const auto j = static_cast<std::size_t>(n);
      return {set.x[j] - set.x[site], set.y[j] - set.y[site]};
    }
    return {n == -1 ? -1.0 : n == -2 ? 1.0 : 0.0, n == -3 ? -1.0 : n == -4 ? 1.0 : 0.0};
  };
  double last = std::numeric_limits<double>::infinity();
  for (const auto n : neighbors) {
    const auto d = direction(n);
    const double angle = std::atan2(d.y, d.x);
    turns += angle < last - 1e-9 ? 1 : 0;
    last = angle;
  }
  const auto first = direction(neighbors.front());
  turns += std::atan2(first.y, first.x) < last - 1e-9 ? 1 : 0;
  return turns <= 2;
}

/// Compares one cell with brute force.
inline void compareCell(const SiteSet& set, std::uint32_t i, CellStatus status,
                        std::span<const std::int32_t> neighbors) {
  constexpr double shortest = 1e-12;  // squares
  const auto edges = edgesByBruteForce(set, i);
  const bool weighted = !set.weight.empty();
  const std::set<std::int32_t> reported(neighbors.begin(), neighbors.end());
  EXPECT_EQ(reported.size(), neighbors.size()) << "site " << i << " has a neighbor twice";
  std::size_t counting = 0;
  for (const auto& [neighbor, ratio] : edges) {
    counting += ratio > shortest ? 1 : 0;
    // A length may be unsure by a twentieth of the shortest.
    if (ratio > 1.3 * shortest) {
      EXPECT_TRUE(reported.contains(neighbor)) << "site " << i << " lacks " << neighbor;
    }
  }
  if (weighted ? edges.empty() : counting == 0) {
    EXPECT_EQ(status, CellStatus::empty) << "site " << i;
  } else if (weighted || counting >= 3) {
    EXPECT_EQ(status, CellStatus::certified) << "site " << i;
  }
  if (status == CellStatus::empty) {
    EXPECT_EQ(neighbors.empty(), !weighted) << "site " << i;
    if (weighted) {
      EXPECT_FALSE(cellByBruteForce(set, i, neighbors).hasArea()) << "site " << i;
    }
    return;
  }
  for (const auto neighbor : reported) {
    EXPECT_TRUE(edges.contains(neighbor)) << "site " << i << " has " << neighbor << ", which is none";
  }
  if (counting >= 3) {
    EXPECT_TRUE(isCounterclockwise(set, i, neighbors)) << "site " << i;
  }
}

/// Compares every cell that is not open with brute force; returns how many are.
inline std::size_t compare(const Finder& finder, const SiteSet& set) {
  const auto found = find(finder, set);
  std::size_t open = 0;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    if (found.status[i] == CellStatus::open) {
      ++open;
      continue;
    }
    const std::span neighbors(found.neighbor.data() + found.offsets[i],
                              found.offsets[i + 1] - found.offsets[i]);
    compareCell(set, i, found.status[i], neighbors);
  }
  return open;
}

inline void compareBoth(const SiteSet& set, std::size_t most_open) {
  {
    SCOPED_TRACE("in double");
    EXPECT_LE(compare(findInDouble, set), most_open);
  }
  if (set.weight.empty()) {
    SCOPED_TRACE("from the mesh");
    EXPECT_EQ(compare(findFromMesh, set), 0U);
  }
  SCOPED_TRACE("exact");
  EXPECT_EQ(compare(findExactly, set), 0U);
}

struct Judge : testing::Test {
  const std::uint64_t seed = std::random_device{}();
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> uniform{0, 1};
  testing::ScopedTrace trace{__FILE__, __LINE__, "seed " + std::to_string(seed)};

  std::vector<Point> points(std::size_t count, const std::function<Point()>& make) {
    std::vector<Point> made;
    for (std::size_t i = 0; i < count; ++i) made.push_back(make());
    return made;
  }
  Point inBox(double x, double y, double size) {
    const double dx = uniform(random);
    return {x + size * dx, y + size * uniform(random)};
  }
};

}  // namespace vorpipe::cpu
