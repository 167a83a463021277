#include "domain/clip_diagram.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "cells/diagram_writer.h"
#include "domain/group_clipper.h"

namespace vorpipe::core {
namespace {

/// Number of cells that share one query for nearby edges: most cells are far from all edges.
constexpr std::size_t group_size = 32;
constexpr std::size_t clip_diagram_grain = 16 * group_size, again_grain = 256;
/// Rounding error of an area along an outline of length 1.
constexpr double line_rounding = 1e-14;

/// With each pass, contacts are closer to the given outline and cells; more than four have not been needed.
constexpr int most_passes = 32;

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Counts the remaining cells.
void countCells(Diagram& diagram) {
  const auto left = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::ok));
  diagram.report.empty += diagram.report.ok - left;
  diagram.report.ok = left;
}

/// Checks that the cells cover the inside exactly once.
Result<void> checkAreas(const ScaledDiagram& cells, const Rings& rings, const Diagram& diagram) {
  const double area = areaInside(rings, cells.domain());
  const double sum = cells.scaled(areaSum(diagram), 2);
  double length = 0;
  for (std::uint32_t e = 0; e < rings.size(); ++e) {
    const Point p = rings.points[e], q = rings.endOf(e);
    length += std::hypot(q.x - p.x, q.y - p.y);
  }
  const Box& box = cells.domain();
  const double largest =
      std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax)});
  if (std::abs(sum - area) <= area_wrong * area + line_rounding * largest * (1 + length)) return {};
  return tl::unexpected(
      refusalOf(Subject::outline, fmt::format("the areas of all cells add up to {} of that inside it, beyond "
                                              "what rounding explains",
                                              sum / area)));
}

/// The result of clipping every cell by itself.
struct FirstPass {
  std::vector<std::uint32_t> near;  ///< cells of the set, ascending
  Contacts contacts;
};

FirstPass clipAll(const ClippedRun& run, const ScaledDiagram& cells, const OutlineIndex& index,
                  ClippedCells& clipped) {
  const std::size_t count = run.set.size();
  std::vector<FirstPass> parts((count + clip_diagram_grain - 1) / clip_diagram_grain);
  parallelFor(count, clip_diagram_grain, run.threads, [&](std::size_t begin, std::size_t end) {
    GroupClipper clipper(run, cells, index, clipped);
    auto& [near, contacts] = parts[begin / clip_diagram_grain];
    for (auto first = begin; first < end; first += group_size) {
      clipper.group(first, std::min(first + group_size, end), near, contacts);
    }
  });
  FirstPass all;
  for (const auto& [near, contacts] : parts) {
    append(all.near, near);
    append(all.contacts.moved, contacts.moved);
    append(all.contacts.nodes, contacts.nodes);
    append(all.contacts.cells, contacts.cells);
    all.contacts.faults = all.contacts.faults || contacts.faults;
  }
  return all;
}

/// Moves vertices of one cell, except off its walls, and measures its edges anew.
void moveVertices(const Box& domain, const ScaledDiagram& cells, std::uint32_t site,
                  std::span<const MovedVertex> moved, Diagram& diagram) {
  bool changed = false;
  for (auto e = cells.begin(site); e < cells.end(site); ++e) {
    const Point from = cells.vertex(e), to = movedPlace(moved, from);
    const auto before = cells.neighbor(e > cells.begin(site) ? e - 1 : cells.end(site) - 1);
    if (to == from || isOffWall(domain, before, to) || isOffWall(domain, cells.neighbor(e), to)) {
      continue;
    }
    diagram.vertices[e] = cells.unscaled(to);
    changed = true;
  }
  if (!changed) return;
  double perimeter = 0;
  for (auto e = cells.begin(site); e < cells.end(site); ++e) {
    const Point a = cells.vertex(e), b = cells.vertex(cells.next(site, e));
    const double length = lengthOf({b.x - a.x, b.y - a.y});
    perimeter += length;
    diagram.edge_lengths[e] = cells.unscaled(length);
  }
  diagram.perimeter[site] = cells.unscaled(perimeter);
}

/// Clips cells again, with nodes as vertices; returns what else they need.
RoundedNodes clipAgain(const ClippedRun& run, const ScaledDiagram& cells, const OutlineIndex& index,
                       std::span<const std::uint32_t> which, std::span<const MovedVertex> moved,
                       std::span<const SideNode> nodes, ClippedCells& clipped) {
  std::vector<RoundedNodes> parts((which.size() + again_grain - 1) / again_grain);
  parallelFor(which.size(), again_grain, run.threads, [&](std::size_t begin, std::size_t end) {
    GroupClipper clipper(run, cells, index, clipped);
    for (auto k = begin; k < end; ++k) clipper.again(which[k], moved, nodes, parts[begin / again_grain]);
  });
  RoundedNodes all;
  for (const auto& [on_edges, on_sides] : parts) {
    append(all.on_edges, on_edges);
    append(all.on_sides, on_sides);
  }
  return all;
}

/// Makes cells and outline meet in bitwise equal points, where they meet exactly or are too close for
/// doubles. Clips affected cells again.
void clipAtContacts(const ClippedRun& run, const ScaledDiagram& cells, const OutlineIndex& index,
                    FirstPass& first, ClippedCells& clipped, Diagram& diagram) {
  auto& [near, contacts] = first;
  const auto moved = agreed(std::move(contacts.moved));
  const bool all = !moved.empty() || !contacts.nodes.empty() || contacts.faults;
  std::span<const std::uint32_t> which = all ? near : contacts.cells;
  if (which.empty()) return;
  if (!moved.empty()) {
    parallelFor(near.size(), again_grain, run.threads, [&](std::size_t begin, std::size_t end) {
      for (auto k = begin; k < end; ++k)
        moveVertices(run.set.domain, cells, cells.siteOf(near[k]), moved, diagram);
    });
  }
  for (auto& [edge, at] : contacts.nodes) {
    const Point p = index.rings().points[edge], q = index.rings().endOf(edge);
    if (const Point to = movedPlace(moved, at); isNearForRounding(p, q, to)) at = to;
  }
  Rings refined;
  std::optional<OutlineIndex> of_refined;
  std::vector<EdgeNode> on_edges = std::move(contacts.nodes);
  std::vector<SideNode> on_sides;
  for (int pass = 0; pass < most_passes; ++pass) {
    if (!on_edges.empty()) {
      refined = withNodes(of_refined ? refined : index.rings(), std::move(on_edges));
      of_refined.emplace(refined);
    }
    auto rounded = clipAgain(run, cells, of_refined ? *of_refined : index, which, moved, on_sides, clipped);
    if (rounded.on_edges.empty() && rounded.on_sides.empty()) return;
    on_edges = std::move(rounded.on_edges);
    append(on_sides, rounded.on_sides);
    sortNodes(on_sides);
    which = near;
  }
  diagram.report.notes.emplace_back(
      "rounding leaves polygons along the outline that cross themselves: fewer digits of its corners help");
}

}  // namespace

Result<OwnParts> clipToOutline(const ClippedRun& run, const Outline& outline, Diagram& diagram) {
  VORPIPE_LET(rings, ringsOf(outline, run.exponent));
  const OutlineIndex index(rings);
  const ScaledDiagram cells(run, diagram);
  ClippedCells clipped(run.sites.size());
  FirstPass first = clipAll(run, cells, index, clipped);
  clipAtContacts(run, cells, index, first, clipped, diagram);
  writeClipped(cells, clipped, diagram);
  OwnParts parts = measureOwnParts(run, index, clipped, first.near, diagram);
  countCells(diagram);
  VORPIPE_TRY(checkAreas(cells, rings, diagram));
  return parts;
}

}  // namespace vorpipe::core
