#include "core/outline/group_clipper.h"

#include <algorithm>

#include "backend/tie.h"
#include "core/outline/clean_rings.h"

namespace vorpipe::core {

GroupClipper::GroupClipper(const ClippedRun& run, const ScaledDiagram& cells, const OutlineIndex& index,
                           ClippedCells& out)
    : cells_(cells),
      index_(index),
      clip_(index),
      out_(out),
      margin_(farthest_moved * shorterSide(cells.domain())),
      finder_(run, index, margin_) {}

void GroupClipper::group(std::size_t first, std::size_t last, std::vector<std::uint32_t>& near,
                         Contacts& found) {
  collect(first, last);
  if (members_.empty()) return;
  findEdges(points_);
  if (near_.empty()) {
    const Fate fate = fateOf(points_[0]);
    for (const auto& member : members_) out_.fate[member.site] = fate;
    return;
  }
  for (const auto& member : members_) {
    const auto sides = sidesOf(member);
    findEdges(sides.vertices);
    auto& fate = out_.fate[member.site];
    if (near_.empty() || member.count == 1) {
      fate = fateOf(sides.from(0));
    } else {
      finder_.find(sides, near_, found);
      fate = clip(sides.vertices, sides.neighbors);
      if (fate == Fate::cut && touchesItself(clipped_)) cleanRings(index_.rings(), near_, clipped_);
      if (fate == Fate::cut) fate = keepPart(member.site);
    }
    if (!near_.empty()) near.push_back(member.cell);
  }
}

void GroupClipper::again(std::uint32_t cell) {
  collect(cell, cell + std::size_t{1});
  if (members_.empty() || members_[0].count == 1) return;
  const auto sides = sidesOf(members_[0]);
  findEdges(sides.vertices);
  const bool has_corners = finder_.insertCorners(sides, near_, vertices_, labels_);
  auto& fate = out_.fate[members_[0].site];
  fate = clip(vertices_, labels_);
  if (fate == Fate::inside && vertices_.size() < 3 && runsAlongOutline(vertices_)) {
    fate = Fate::outside;
  } else if (fate == Fate::inside && has_corners) {
    clipped_ = {vertices_, labels_, {0}, {false}, {}};
    fate = keepPart(members_[0].site);
  } else if (fate == Fate::cut) {
    cleanRings(index_.rings(), near_, clipped_);
    fate = keepPart(members_[0].site);
  }
}

void GroupClipper::collect(std::size_t first_cell, std::size_t last_cell) {
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
void GroupClipper::findEdges(std::span<const Point> places) {
  const Box box = boxOf(places);
  index_.edgesIn({box.xmin - margin_, box.ymin - margin_, box.xmax + margin_, box.ymax + margin_}, near_);
}

/// Whether a cell that rounding has left no width lies in an edge of the outline.
bool GroupClipper::runsAlongOutline(std::span<const Point> cell) const {
  return std::ranges::any_of(near_, [&](std::uint32_t e) {
    const Point p = index_.rings().points[e], q = index_.rings().points[index_.rings().next(e)];
    return (p == cell.front() && q == cell.back()) || (q == cell.front() && p == cell.back());
  });
}

CellSides GroupClipper::sidesOf(const Member& member) const {
  return {member.cell, std::span(points_).subspan(member.first, member.count),
          std::span(neighbors_).subspan(member.first, member.count)};
}

Fate GroupClipper::clip(std::span<const Point> vertices, std::span<const std::int64_t> neighbors) {
  switch (clip_.clip(vertices, neighbors, near_, clipped_)) {
    case OutlineClip::Outcome::inside:
      return Fate::inside;
    case OutlineClip::Outcome::outside:
      return Fate::outside;
    case OutlineClip::Outcome::cut:
      return Fate::cut;
    case OutlineClip::Outcome::crossed:
      break;
  }
  return fateOf(vertices[0]);
}

/// What is left of a cell, if anything is.
Fate GroupClipper::keepPart(std::uint32_t site) {
  if (clipped_.vertices.empty()) return Fate::outside;
  out_.parts[site] = std::make_unique<ClippedCell>(clipped_);
  out_.parts[site]->sortEdges();
  return Fate::cut;
}

}  // namespace vorpipe::core
