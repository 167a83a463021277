#include "cli/check_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/checked_run.h"
#include "cli/stats.h"

namespace vorpipe::cli {
namespace {

/// Of the domain's area.
constexpr double area_slack = 1e-6;

std::string brokenArrays(const CheckedRun& run) {
  const Diagram& d = run.diagram;
  const std::size_t n = run.input.sites.size();
  for (const std::size_t size : {d.status.size(), d.owner.size(), d.area.size(), d.perimeter.size(),
                                 d.centroid.size(), d.second_moments.size()}) {
    if (size != n) return fmt::format("an array of {} records for {} sites", size, n);
  }
  const auto& offsets = d.cell_offsets;
  if (offsets.size() != n + 1 || offsets.front() != 0 || !std::ranges::is_sorted(offsets)) {
    return "the cells' offsets do not ascend from 0";
  }
  for (const std::size_t size : {d.vertices.size(), d.neighbors.size(), d.edge_lengths.size()}) {
    if (size != offsets.back()) return fmt::format("an array of {} entries for {}", size, offsets.back());
  }
  return {};
}

std::string brokenStatus(const CheckedRun& run) {
  const Diagram& d = run.diagram;
  std::array<std::uint64_t, 3> counts{};
  for (std::size_t i = 0; i < run.input.sites.size(); ++i) {
    ++counts[static_cast<std::size_t>(d.status[i])];
    const std::size_t owner = d.owner[i];
    const bool right = d.status[i] == Status::duplicate ? owner < i && d.status[owner] != Status::duplicate &&
                                                              run.site(owner) == run.site(i)
                                                        : owner == i;
    if (!right) return fmt::format("site {} cannot be owned by site {}", i, owner);
    if (d.status[i] == Status::empty && run.inDomain(run.site(i))) {
      return fmt::format("site {} lies in the domain and cannot be empty", i);
    }
    if (!run.ok(i) && (run.begin(i) != run.end(i) || d.area[i] != 0 || d.perimeter[i] != 0)) {
      return fmt::format("site {} has no cell, but {} edges and area {}", i, run.end(i) - run.begin(i),
                         d.area[i]);
    }
  }
  const Report& r = d.report;
  if (counts == std::array{r.ok, r.empty, r.duplicate}) return {};
  return fmt::format("counted {} ok, {} empty, {} duplicate, reported {}, {}, {}", counts[0], counts[1],
                     counts[2], r.ok, r.empty, r.duplicate);
}

std::string brokenNeighborIndex(const CheckedRun& run) {
  for (std::size_t i = 0; i < run.input.sites.size(); ++i) {
    for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
      const std::int64_t neighbor = run.diagram.neighbors[e];
      const auto j = static_cast<std::size_t>(neighbor);
      if (neighbor < 0 ? neighbor >= wall_ymax : j < run.input.sites.size() && j != i && run.ok(j)) continue;
      return fmt::format("site {} has neighbor {}, which is no wall and no other site with a cell", i,
                         neighbor);
    }
  }
  return {};
}

/// An edge between two sites, as one of their cells has it.
struct HalfEdge {
  std::uint32_t low, high;
  std::uint64_t edge;
  auto operator<=>(const HalfEdge&) const = default;
};

std::string brokenPair(const CheckedRun& run, const HalfEdge& a, const HalfEdge& b) {
  const Diagram& d = run.diagram;
  const bool same =
      d.vertices[a.edge] == run.after(a.high, b.edge) && d.vertices[b.edge] == run.after(a.low, a.edge);
  if (!same) return fmt::format("the edge of sites {} and {} ends elsewhere in each cell", a.low, a.high);
  if (d.edge_lengths[a.edge] == d.edge_lengths[b.edge]) return {};
  return fmt::format("the edge of sites {} and {} is {} long in one cell and {} in the other", a.low, a.high,
                     d.edge_lengths[a.edge], d.edge_lengths[b.edge]);
}

std::string brokenSymmetry(const CheckedRun& run) {
  std::vector<HalfEdge> halves;
  halves.reserve(run.diagram.neighbors.size());
  for (std::uint32_t i = 0; i < run.input.sites.size(); ++i) {
    for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
      if (run.diagram.neighbors[e] < 0) continue;
      const auto j = static_cast<std::uint32_t>(run.diagram.neighbors[e]);
      halves.push_back({std::min(i, j), std::max(i, j), e});
    }
  }
  std::ranges::sort(halves);
  for (std::size_t k = 0; k < halves.size(); k += 2) {
    const HalfEdge& a = halves[k];
    const bool paired = k + 1 < halves.size() && halves[k + 1].low == a.low && halves[k + 1].high == a.high &&
                        a.edge < run.end(a.low) && halves[k + 1].edge >= run.begin(a.high);
    if (!paired) return fmt::format("sites {} and {} do not each name the other once", a.low, a.high);
    if (std::string broken = brokenPair(run, a, halves[k + 1]); !broken.empty()) return broken;
  }
  return {};
}

std::string brokenArea(const CheckedRun& run) {
  const Box& box = run.domain();
  const double domain = (box.xmax - box.xmin) * (box.ymax - box.ymin);
  const double sum = areaSum(run.diagram);
  if (std::abs(sum - domain) <= area_slack * domain) return {};
  return fmt::format("the areas add up to {}, the domain has {}", sum, domain);
}

/// Euler's formula for the domain cut into cells. An edge without length is no edge, and a cell without
/// others no face: where ties left nothing of a cell.
std::string brokenEuler(const CheckedRun& run) {
  std::vector<Point> vertices = run.diagram.vertices;
  std::ranges::sort(vertices, [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  const auto repeated = std::ranges::unique(vertices, [](Point a, Point b) { return a == b; });
  const std::size_t distinct = vertices.size() - repeated.size();
  std::size_t edges = 0, faces = 1;
  for (std::size_t i = 0; i < run.input.sites.size(); ++i) {
    bool has_edge = false;
    for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
      if (run.diagram.vertices[e] == run.after(i, e)) continue;
      has_edge = true;
      const std::int64_t neighbor = run.diagram.neighbors[e];
      edges += neighbor < 0 || static_cast<std::size_t>(neighbor) > i ? 1 : 0;
    }
    faces += has_edge ? 1 : 0;
  }
  if (distinct + faces == edges + 2) return {};
  return fmt::format(
      "the domain has {} vertices, {} edges and {} faces with the outside, which is no partition", distinct,
      edges, faces);
}

}  // namespace

std::string checkCells(const Input& input, const Diagram& diagram) {
  const CheckedRun run{input, diagram};
  // In this order: each may rely on those before it.
  for (const auto check : {brokenArrays, brokenStatus, brokenNeighborIndex, brokenSymmetry, brokenPolygon,
                           brokenArea, brokenEuler, brokenNearest}) {
    if (std::string broken = check(run); !broken.empty()) return broken;
  }
  return {};
}

}  // namespace vorpipe::cli
