#include "core/outline/clip_diagram.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/parallel.h"
#include "base/refusal.h"
#include "core/diagram/diagram_writer.h"
#include "core/outline/clip_cell.h"
#include "core/outline/clipped_records.h"

namespace vorpipe::core {
namespace {

/// Cells that share one query for the edges near them: most cells are far from all edges.
constexpr std::size_t group_size = 32;
constexpr std::size_t grain = 16 * group_size;
/// Rounding error of an area along an outline of length 1.
constexpr double line_rounding = 1e-14;

/// Clips cells, group by group.
class GroupClipper {
 public:
  GroupClipper(const ScaledDiagram& cells, const OutlineIndex& index, ClippedCells& out)
      : cells_(cells), index_(index), clip_(index), out_(out) {}

  void group(std::span<const std::uint32_t> sites) {
    collect(sites);
    if (members_.empty()) return;
    index_.edgesIn(boxOf(points_), near_);
    if (!near_.empty()) {
      for (const auto& member : members_) clipOne(member);
      return;
    }
    const bool inside = index_.contains(points_[0]);
    for (const auto& member : members_) out_.fate[member.site] = inside ? Fate::inside : Fate::outside;
  }

 private:
  struct Member {
    std::uint32_t site;
    std::size_t first, count;  ///< of points_ and neighbors_
  };

  void collect(std::span<const std::uint32_t> sites) {
    members_.clear();
    points_.clear();
    neighbors_.clear();
    for (const auto site : sites) {
      if (!cells_.hasCell(site)) continue;
      const std::size_t first = points_.size();
      cells_.appendCell(site, points_, neighbors_);
      // A cell all of whose edges are ties has none.
      if (points_.size() == first) {
        points_.push_back(cells_.centroid(site));
        neighbors_.push_back(wall_outline);
      }
      members_.push_back({site, first, points_.size() - first});
    }
  }

  void clipOne(const Member& member) {
    const auto vertices = std::span(points_).subspan(member.first, member.count);
    const auto neighbors = std::span(neighbors_).subspan(member.first, member.count);
    using Outcome = OutlineClip::Outcome;
    const Outcome outcome = member.count == 1
                                ? (index_.contains(vertices[0]) ? Outcome::inside : Outcome::outside)
                                : clip_.clip(vertices, neighbors, near_, clipped_);
    out_.fate[member.site] = outcome == Outcome::cut      ? Fate::cut
                             : outcome == Outcome::inside ? Fate::inside
                                                          : Fate::outside;
    if (outcome == Outcome::cut) out_.parts[member.site] = std::make_unique<ClippedCell>(clipped_);
  }

  const ScaledDiagram& cells_;
  const OutlineIndex& index_;
  OutlineClip clip_;
  ClippedCells& out_;
  std::vector<Member> members_;
  std::vector<Point> points_;
  std::vector<std::int64_t> neighbors_;
  std::vector<std::uint32_t> near_;
  ClippedCell clipped_;
};

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

Result<void> clipToOutline(const ClippedRun& run, const Outline& outline, Diagram& diagram) {
  const auto rings = ringsOf(outline, run.exponent);
  if (!rings) return tl::unexpected(rings.error());
  const ScaledDiagram cells(run, diagram);
  ClippedCells clipped(run.sites.size());
  {
    const OutlineIndex index(*rings);
    parallelFor(run.order.size(), grain, run.threads, [&](std::size_t begin, std::size_t end) {
      GroupClipper clipper(cells, index, clipped);
      for (auto first = begin; first < end; first += group_size) {
        clipper.group(std::span(run.order).subspan(first, std::min(group_size, end - first)));
      }
    });
  }
  writeClipped(cells, clipped, diagram);
  return checkAreas(cells, *rings, diagram);
}

}  // namespace vorpipe::core
