#include "core/outline/clip_diagram.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/parallel.h"
#include "base/refusal.h"
#include "core/diagram/diagram_writer.h"
#include "core/outline/clip_cell.h"
#include "core/outline/own_parts.h"

namespace vorpipe::core {
namespace {

/// Cells that share one query for the edges near them: most cells are far from all edges.
constexpr std::size_t group_size = 32;
constexpr std::size_t clip_diagram_grain = 16 * group_size;
/// Of the domain's shorter side: farther no tie moves a corner, nor a cell without edges from its centroid.
constexpr double farthest_moved = 2e-4;
/// Rounding error of an area along an outline of length 1.
constexpr double line_rounding = 1e-14;

/// Clips cells, group by group.
class GroupClipper {
 public:
  GroupClipper(const ScaledDiagram& cells, const OutlineIndex& index, ClippedCells& out)
      : cells_(cells),
        index_(index),
        clip_(index),
        out_(out),
        margin_(farthest_moved * shorterSide(cells.domain())) {}

  /// Clips the cells `first` to `last` - 1 of the set, and adds those to `near` whose own corners may be on
  /// another side of the outline.
  void group(std::size_t first, std::size_t last, std::vector<std::uint32_t>& near) {
    collect(first, last);
    if (members_.empty()) return;
    findEdges(points_);
    if (near_.empty()) {
      const Fate fate = fateOf(points_[0]);
      for (const auto& member : members_) out_.fate[member.site] = fate;
      return;
    }
    for (const auto& member : members_) {
      const auto vertices = std::span(points_).subspan(member.first, member.count);
      findEdges(vertices);
      out_.fate[member.site] = near_.empty() ? fateOf(vertices[0]) : clipOne(member);
      if (!near_.empty()) near.push_back(member.cell);
    }
  }

 private:
  struct Member {
    std::uint32_t cell, site;
    std::size_t first, count;  ///< of points_ and neighbors_
  };

  void collect(std::size_t first_cell, std::size_t last_cell) {
    members_.clear();
    points_.clear();
    neighbors_.clear();
    for (auto cell = first_cell; cell < last_cell; ++cell) {
      const auto site = cells_.siteOf(cell);
      if (!cells_.hasCell(site)) continue;
      const std::size_t first = points_.size();
      cells_.appendCell(site, points_, neighbors_);
      // A cell all of whose edges are ties has none.
      if (points_.size() == first) {
        points_.push_back(cells_.centroid(site));
        neighbors_.push_back(wall_outline);
      }
      members_.push_back({static_cast<std::uint32_t>(cell), site, first, points_.size() - first});
    }
  }

  /// Edges that any of these places, each moved by as much as ties may move it, may lie at.
  void findEdges(std::span<const Point> places) {
    const Box box = boxOf(places);
    index_.edgesIn({box.xmin - margin_, box.ymin - margin_, box.xmax + margin_, box.ymax + margin_}, near_);
  }

  [[nodiscard]] Fate fateOf(Point p) const { return index_.contains(p) ? Fate::inside : Fate::outside; }

  Fate clipOne(const Member& member) {
    const auto vertices = std::span(points_).subspan(member.first, member.count);
    const auto neighbors = std::span(neighbors_).subspan(member.first, member.count);
    if (member.count == 1) return fateOf(vertices[0]);
    switch (clip_.clip(vertices, neighbors, near_, clipped_)) {
      case OutlineClip::Outcome::inside:
        return Fate::inside;
      case OutlineClip::Outcome::outside:
        return Fate::outside;
      case OutlineClip::Outcome::cut:
        out_.parts[member.site] = std::make_unique<ClippedCell>(clipped_);
        out_.parts[member.site]->sortEdges();
        return Fate::cut;
      case OutlineClip::Outcome::crossed:
        break;
    }
    return fateOf(vertices[0]);
  }

  const ScaledDiagram& cells_;
  const OutlineIndex& index_;
  OutlineClip clip_;
  ClippedCells& out_;
  double margin_;
  std::vector<Member> members_;
  std::vector<Point> points_;
  std::vector<std::int64_t> neighbors_;
  std::vector<std::uint32_t> near_;
  ClippedCell clipped_;
};

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

}  // namespace

Result<OwnParts> clipToOutline(const ClippedRun& run, const Outline& outline, Diagram& diagram) {
  const auto rings = ringsOf(outline, run.exponent);
  if (!rings) return tl::unexpected(rings.error());
  const ScaledDiagram cells(run, diagram);
  ClippedCells clipped(run.sites.size());
  const OutlineIndex index(*rings);
  const std::size_t count = run.set.size();
  std::vector<std::vector<std::uint32_t>> near_of((count + clip_diagram_grain - 1) / clip_diagram_grain);
  parallelFor(count, clip_diagram_grain, run.threads, [&](std::size_t begin, std::size_t end) {
    GroupClipper clipper(cells, index, clipped);
    for (auto first = begin; first < end; first += group_size) {
      clipper.group(first, std::min(first + group_size, end), near_of[begin / clip_diagram_grain]);
    }
  });
  std::vector<std::uint32_t> near;
  for (const auto& some : near_of) near.insert(near.end(), some.begin(), some.end());
  writeClipped(cells, clipped, diagram);
  OwnParts parts = measureOwnParts(run, index, clipped, near, diagram);
  countCells(diagram);
  if (auto right = checkAreas(cells, *rings, diagram); !right) return tl::unexpected(right.error());
  return parts;
}

}  // namespace vorpipe::core
