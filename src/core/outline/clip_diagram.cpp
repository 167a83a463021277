#include "core/outline/clip_diagram.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/refusal.h"
#include "core/diagram/diagram_writer.h"
#include "core/outline/group_clipper.h"
#include "core/outline/own_parts.h"

namespace vorpipe::core {
namespace {

/// Cells that share one query for the edges near them: most cells are far from all edges.
constexpr std::size_t group_size = 32;
constexpr std::size_t clip_diagram_grain = 16 * group_size, again_grain = 256;
/// Rounding error of an area along an outline of length 1.
constexpr double line_rounding = 1e-14;

/// Counts the cells that are left.
void countCells(Diagram& diagram) {
  const auto left = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::ok));
  diagram.report.empty += diagram.report.ok - left;
  diagram.report.ok = left;
}

/// Checks that the cells cover the inside once.
Result<void> checkAreas(const ScaledDiagram& cells, const Rings& rings, const Diagram& diagram) {
  const double area = areaInside(rings, cells.domain());
  const double sum = cells.scaled(areaSum(diagram), 2);
  double length = 0;
  for (std::uint32_t e = 0; e < rings.size(); ++e) {
    const Point p = rings.points[e], q = rings.points[rings.next(e)];
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

/// What is known after every cell was clipped for itself.
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
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (const auto& [near, contacts] : parts) {
    append(all.near, near);
    append(all.contacts.moved, contacts.moved);
    append(all.contacts.nodes, contacts.nodes);
    append(all.contacts.cells, contacts.cells);
  }
  return all;
}

/// Moves vertices of one cell, and measures its edges anew.
void moveVertices(const ScaledDiagram& cells, std::uint32_t site, std::span<const MovedVertex> moved,
                  Diagram& diagram) {
  bool changed = false;
  for (auto e = cells.begin(site); e < cells.end(site); ++e) {
    const Point from = cells.vertex(e), to = movedPlace(moved, from);
    if (to == from) continue;
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

/// Has cells and outline meet in the same points, to the bit, where they meet exactly, and clips cells again
/// for which that changes anything.
void clipAtContacts(const ClippedRun& run, const ScaledDiagram& cells, const OutlineIndex& index,
                    FirstPass& first, ClippedCells& clipped, Diagram& diagram) {
  auto& [near, contacts] = first;
  const auto moved = agreed(std::move(contacts.moved));
  const auto& which = moved.empty() && contacts.nodes.empty() ? contacts.cells : near;
  if (which.empty()) return;
  if (!moved.empty()) {
    parallelFor(near.size(), again_grain, run.threads, [&](std::size_t begin, std::size_t end) {
      for (auto k = begin; k < end; ++k) moveVertices(cells, cells.siteOf(near[k]), moved, diagram);
    });
  }
  for (auto& node : contacts.nodes) node.at = movedPlace(moved, node.at);
  Rings refined;
  std::optional<OutlineIndex> of_refined;
  if (!contacts.nodes.empty()) {
    refined = withNodes(index.rings(), std::move(contacts.nodes));
    of_refined.emplace(refined);
  }
  parallelFor(which.size(), again_grain, run.threads, [&](std::size_t begin, std::size_t end) {
    GroupClipper clipper(run, cells, of_refined ? *of_refined : index, clipped);
    for (auto k = begin; k < end; ++k) clipper.again(which[k]);
  });
}

}  // namespace

Result<OwnParts> clipToOutline(const ClippedRun& run, const Outline& outline, Diagram& diagram) {
  const auto rings = ringsOf(outline, run.exponent);
  if (!rings) return tl::unexpected(rings.error());
  const OutlineIndex index(*rings);
  const ScaledDiagram cells(run, diagram);
  ClippedCells clipped(run.sites.size());
  FirstPass first = clipAll(run, cells, index, clipped);
  clipAtContacts(run, cells, index, first, clipped, diagram);
  writeClipped(cells, clipped, diagram);
  OwnParts parts = measureOwnParts(run, index, clipped, first.near, diagram);
  countCells(diagram);
  if (auto right = checkAreas(cells, *rings, diagram); !right) return tl::unexpected(right.error());
  return parts;
}

}  // namespace vorpipe::core
