/// Cells to propose to the assembly, found by clipping with every site that could matter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "backend/collect.h"
#include "core/diagram/diagram_writer.h"
#include "core/diagram/dual_triangles.h"
#include "core/ties/tied_records.h"

namespace vorpipe::test {

using namespace core;

using Rows = std::vector<std::vector<std::int32_t>>;

inline SiteSet sitesAt(std::vector<double> x, std::vector<double> y) {
  SiteSet set;
  set.x = std::move(x);
  set.y = std::move(y);
  set.domain = {0, 0, 1, 1};
  set.id.resize(set.x.size());
  std::iota(set.id.begin(), set.id.end(), 0u);
  return set;
}

/// side x side sites in the unit square, each moved by up to `jitter` of a lattice step, with shuffled ids.
inline SiteSet jitteredSites(std::size_t side, double jitter, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> moved(-jitter, jitter);
  std::vector<double> x, y;
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      x.push_back((static_cast<double>(column) + 0.5 + moved(random)) / static_cast<double>(side));
      y.push_back((static_cast<double>(row) + 0.5 + moved(random)) / static_cast<double>(side));
    }
  }
  auto set = sitesAt(std::move(x), std::move(y));
  std::shuffle(set.id.begin(), set.id.end(), random);
  return set;
}

/// A convex polygon whose edge k, from point k to the next, belongs to neighbor k.
struct ClippedCell {
  std::vector<Point> point;
  std::vector<std::int32_t> neighbor;
};

/// Keeps where p . n <= h; what touches the line counts as inside, so that ties come out at random.
inline void cut(ClippedCell& cell, Point n, double h, std::int32_t neighbor) {
  const auto excess = [&](Point p) { return p.x * n.x + p.y * n.y - h; };
  if (std::none_of(cell.point.begin(), cell.point.end(), [&](Point p) { return excess(p) > 0; })) return;
  ClippedCell left;
  for (std::size_t k = 0; k < cell.point.size(); ++k) {
    const Point a = cell.point[k], b = cell.point[(k + 1) % cell.point.size()];
    const double beyond_a = excess(a), beyond_b = excess(b);
    const double part = beyond_a / (beyond_a - beyond_b);
    const Point crossing{a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
    if (beyond_a <= 0) {
      left.point.push_back(a);
      left.neighbor.push_back(cell.neighbor[k]);
      if (beyond_b > 0) {
        left.point.push_back(crossing);
        left.neighbor.push_back(neighbor);
      }
    } else if (beyond_b <= 0) {
      left.point.push_back(crossing);
      left.neighbor.push_back(cell.neighbor[k]);
    }
  }
  cell = left.point.size() >= 3 ? left : ClippedCell{};
}

/// The rows of all cells; candidates(i) are the sites that may cut cell i.
template <class Candidates>
Rows clippedRows(const SiteSet& set, const Candidates& candidates) {
  Rows rows(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    const Box& box = set.domain;
    const Point site{set.x[i], set.y[i]};
    ClippedCell cell{{{box.xmin - site.x, box.ymin - site.y},
                      {box.xmax - site.x, box.ymin - site.y},
                      {box.xmax - site.x, box.ymax - site.y},
                      {box.xmin - site.x, box.ymax - site.y}},
                     {wall_ymin, wall_xmax, wall_ymax, wall_xmin}};
    for (const std::size_t j : candidates(i)) {
      if (j == i) continue;
      const Point d{set.x[j] - site.x, set.y[j] - site.y};
      cut(cell, d, (d.x * d.x + d.y * d.y) / 2, static_cast<std::int32_t>(j));
    }
    rows[i] = cell.neighbor;
  }
  return rows;
}

/// The rows when every site is a candidate.
inline Rows rowsOf(const SiteSet& set) {
  std::vector<std::size_t> all(set.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return clippedRows(
      set, [&](std::size_t) -> const auto& { return all; });
}

/// The rows of jitteredSites(side, at most 0.4): no point is farther than 0.9 sqrt(2) lattice steps from a
/// site, no neighbor farther than twice that, so that three steps and the jitter reach it.
inline Rows rowsOfJittered(const SiteSet& set, std::size_t side) {
  return clippedRows(set, [&](std::size_t i) {
    constexpr std::size_t reach = 3;
    std::vector<std::size_t> near;
    const auto row = i / side, column = i % side;
    for (auto r = row - std::min(row, reach); r <= std::min(row + reach, side - 1); ++r) {
      for (auto c = column - std::min(column, reach); c <= std::min(column + reach, side - 1); ++c) {
        near.push_back(r * side + c);
      }
    }
    return near;
  });
}

inline CellNeighbors cellsOf(const Rows& rows) {
  CellNeighbors cells;
  cells.offsets.push_back(0);
  for (const auto& row : rows) {
    cells.status.push_back(row.empty() ? CellStatus::empty : CellStatus::certified);
    cells.neighbor.insert(cells.neighbor.end(), row.begin(), row.end());
    cells.offsets.push_back(cells.neighbor.size());
    beginAtFirst(std::span(cells.neighbor).last(row.size()));
  }
  return cells;
}

/// What the assembly makes of proposed cells; `diagram` is complete when nothing is in dispute.
struct Assembled {
  Diagram diagram;
  std::size_t suspect = 0;
  std::size_t tied_vertices = 0;
  std::vector<std::uint32_t> disputed;
};

inline Assembled assemble(const SiteSet& set, CellNeighbors found, int threads = 1,
                          Detail detail = Detail::everything) {
  Assembled result;
  std::vector<std::uint32_t> all(set.size());
  std::iota(all.begin(), all.end(), 0u);
  NeighborRows cells(set.size(), threads);
  cells.add(all, std::move(found));
  Prepared prepared;
  prepared.set = set;
  prepared.owner.resize(set.size());
  std::iota(prepared.owner.begin(), prepared.owner.end(), 0u);
  const Sites none{std::vector<double>(set.size()), std::vector<double>(set.size()), {}};
  auto by_input = makeRecords(prepared, none);
  const Records records{prepared.set, Unscale(0), by_input};
  const EdgeIndex index(cells, threads);
  const ProposedCells proposed{set, cells, index, threads};
  std::vector<std::uint8_t> suspect(set.size());
  checkCells(proposed, records, suspect);
  result.suspect = static_cast<std::size_t>(std::count(suspect.begin(), suspect.end(), 1));
  const auto tied = resolveTies(proposed, suspect, Fineness{}, Disputes::are_listed);
  result.disputed = tied->disputed;
  result.tied_vertices = tied->position.size();
  if (!tied->disputed.empty()) return result;
  recordTiedCells(proposed, *tied, records);
  takeRecords(by_input, detail, threads, result.diagram);
  writeEdges(proposed, *tied, detail, records.unscale, result.diagram);
  if (detail == Detail::everything) {
    SiteMesh mesh(proposed.sites, threads);
    result.diagram.triangles = dualTriangles(proposed, *tied, mesh);
  }
  return result;
}

}  // namespace vorpipe::test
