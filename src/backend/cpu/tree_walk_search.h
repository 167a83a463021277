/// The search of tree_walk.h.
#pragma once

#include "backend/cpu/tree_walk.h"
#include "backend/cpu/tree_walk_corners.h"

namespace vorpipe::cpu {

/// The most sites in the subtree around the cell's own site that is tried first.
constexpr std::uint32_t near_sites = 24;
/// The most cuts by sites of one subtree before tryAll gives way to tryDeepest.
constexpr std::uint32_t few_cuts = 5;
/// The most leaves of one subtree that tryAll tries before it gives way to tryDeepest.
constexpr int few_leaves = 24;
/// The most rounds of cutting by sites that seemed to be ties, before the cell is left to more digits.
constexpr int most_rounds = 8;

template <class Real, std::size_t Room>
CellStatus TreeWalk<Real, Room>::find(std::uint32_t site, const Vector<Real>& origin_offset,
                                      const Walls<Real>& walls, Found<Real>& found) {
  site_ = site;
  site_x_ = sites_.x[site];
  site_y_ = sites_.y[site];
  weight_ = hasWeights() ? sites_.weight[site] : 0;
  origin_offset_ = origin_offset;
  clip_.beginCell(cell_, vec4(walls.west, walls.south, walls.east, walls.north));
  static_assert(Room % 4 == 0);
  for (std::size_t k = 0; k < Room; ++k) {
    if (walls.inner[k % 4]) cell_.line[k] = inner_wall;
    line_[k] = no_line;
  }
  doubtful_.clear();
  surely_empty_ = false;
  blur_ = Real(0.0);
  new_moved_ = Real(0.0);
  findCorners();
  climb();
  return finish(found);
}

template <class Real, std::size_t Room>
void TreeWalk<Real, Room>::climb() {
  const auto own = tree_.rank[site_];
  std::uint32_t node = 1;
  auto range = tree_.all();
  beside_.clear();
  while (!tree_.isLeaf(node) && range.end - range.begin > near_sites) {
    const SiteTree::Range low{range.begin, range.middle()};
    const SiteTree::Range high{range.middle(), range.end};
    const bool is_low = own < low.end;
    beside_.push_back({is_low ? 2 * node + 1 : 2 * node, is_low ? high : low, Real(0.0), 0});
    node = is_low ? 2 * node : 2 * node + 1;
    range = is_low ? low : high;
  }
  std::reverse(beside_.begin(), beside_.end());
  for (const auto heavy : sites_.heavy) {
    if (heavy != site_ && !isOver()) tryRank(tree_.rank[heavy]);
  }
  tryNear(range);
  for (std::size_t beside = 0; beside < beside_.size() && !isOver(); ++beside) {
    if (tryAll(beside)) continue;
    tryDeepest(beside);
    break;
  }
}

/// Tries the sites of `range`, nearest by power first: most sites that cut in this order turn out to be
/// neighbors.
template <class Real, std::size_t Room>
void TreeWalk<Real, Room>::tryNear(SiteTree::Range range) {
  const auto own = tree_.rank[site_];
  nearest_.clear();
  for (auto rank = range.begin; rank < range.end; ++rank) {
    const double dx = tree_.x[rank] - site_x_;
    const double dy = tree_.y[rank] - site_y_;
    if (rank == own) continue;
    nearest_.push_back({dx * dx + dy * dy - (hasWeights() ? tree_.weight[rank] - weight_ : 0), rank});
  }
  std::sort(nearest_.begin(), nearest_.end());
  for (const auto& [power, rank] : nearest_) {
    if (!isOver()) tryRank(rank);
  }
}

template <class Real, std::size_t Room>
template <class Reach>
auto TreeWalk<Real, Room>::children(const Subtree& parent, const Reach& reachOf) const {
  const auto& [node, range, reached, version] = parent;
  const Subtree low{2 * node, {range.begin, range.middle()}, reachOf(tree_.bounds[2 * node]), version_};
  const Subtree high{
      2 * node + 1, {range.middle(), range.end}, reachOf(tree_.bounds[2 * node + 1]), version_};
  return std::pair{low, high};
}

/// Tries all sites of a subtree whose boxes reach into a corner's circle. Returns false if that takes so long
/// that tryDeepest is better.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::tryAll(std::size_t beside) {
  const auto many_cuts = version_ + few_cuts;
  int leaves = 0;
  pending_.assign(1, beside_[beside]);
  pending_.back().version = version_ - 1;
  while (!pending_.empty() && !isOver()) {
    auto next = pending_.back();
    pending_.pop_back();
    if (next.version != version_) next.reach = reach(tree_.bounds[next.node]);
    if (!isWorthwhile(next)) continue;
    if (version_ > many_cuts || leaves > few_leaves) return false;
    if (tree_.isLeaf(next.node)) {
      ++leaves;
      tryLeaf(next.range);
      continue;
    }
    const auto [low, high] = children(next, [&](const Bounds& bounds) { return reach(bounds); });
    pending_.push_back(high.reach < low.reach ? high : low);
    pending_.push_back(high.reach < low.reach ? low : high);
  }
  return true;
}

template <class Real, std::size_t Room>
void TreeWalk<Real, Room>::tryLeaf(SiteTree::Range range) {
  for (auto rank = range.begin; rank < range.end && !isOver(); ++rank) tryRank(rank);
}

template <class Real, std::size_t Room>
void TreeWalk<Real, Room>::tryRank(std::uint32_t rank) {
  const auto d = offsetToRank(rank);
  bool perhaps = false;
  bool wholly = false;
  const bool surely = isCut(d, perhaps, wholly);
  if (!perhaps) return;
  doubtful_.push_back(tree_.site[rank]);
  surely_empty_ = wholly;
  if (surely) cut(d, static_cast<std::int32_t>(tree_.site[rank]));
}

/// Cuts each corner off by the site deepest in its circle, until no site of the subtrees from `beside` on
/// cuts a corner. A corner that no site cuts is `known` until another cut removes it.
template <class Real, std::size_t Room>
void TreeWalk<Real, Room>::tryDeepest(std::size_t beside) {
  for (std::size_t k = 0; k < Room; ++k) known_after_[k] = no_line;
  for (std::size_t c = 0; c < corners_; ++c) corner_[c].known = false;
  for (std::size_t c = 0; c < corners_ && !isOver();) {
    if (corner_[c].known) {
      ++c;
      continue;
    }
    const auto deepest = findDeepest(c, beside);
    if (deepest.found) {
      const auto d = offsetToRank(deepest.rank);
      const auto site = tree_.site[deepest.rank];
      bool perhaps = false;
      isCut(d, perhaps, surely_empty_);
      doubtful_.push_back(site);
      cut(d, static_cast<std::int32_t>(site));
      c = 0;
    } else {
      corner_[c].known = true;
      known_after_[corner_[c].before] = cell_.line[corner_[c].after];
    }
  }
}

template <class Real, std::size_t Room>
typename TreeWalk<Real, Room>::Deepest TreeWalk<Real, Room>::findDeepest(std::size_t corner,
                                                                         std::size_t beside) {
  Deepest deepest{Real(0.0), 0, false};
  pending_.clear();
  for (auto k = beside_.size(); k-- > beside;) {
    pending_.push_back(beside_[k]);
    pending_.back().reach = reach(corner, tree_.bounds[beside_[k].node]);
    if (pending_.back().reach < -margin_[corner]) pending_.pop_back();
  }
  std::stable_sort(pending_.begin(), pending_.end(),
                   [](const auto& a, const auto& b) { return a.reach < b.reach; });
  while (!pending_.empty()) {
    const auto next = pending_.back();
    pending_.pop_back();
    if (!isWorthwhile(corner, next, deepest)) continue;
    if (tree_.isLeaf(next.node)) {
      searchLeaf(corner, next.range, deepest);
      continue;
    }
    const auto [low, high] = children(next, [&](const Bounds& bounds) { return reach(corner, bounds); });
    pending_.push_back(high.reach < low.reach ? high : low);
    pending_.push_back(high.reach < low.reach ? low : high);
  }
  return deepest;
}

/// Whether a subtree may hold a site deeper in the corner's circle than `deepest`, or, if no site was found
/// so far, a tie that matters.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::isWorthwhile(std::size_t corner, const Subtree& subtree, const Deepest& deepest) {
  if (subtree.reach > max(deepest.depth, margin_[corner])) return true;
  if (deepest.found || subtree.reach < -margin_[corner]) return false;
  return mayMatter(corner, tree_.bounds[subtree.node], subtree.reach);
}

/// Whether a subtree may hold a site that cuts the cell, or a tie that matters.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::isWorthwhile(const Subtree& subtree) {
  if (subtree.reach > most_margin_) return true;
  if (subtree.reach < -most_margin_) return false;
  const auto& bounds = tree_.bounds[subtree.node];
  for (std::size_t c = 0; c < corners_; ++c) {
    const auto reached = reach(c, bounds);
    if (reached > margin_[c] || (reached >= -margin_[c] && mayMatter(c, bounds, reached))) return true;
  }
  return false;
}

template <class Real, std::size_t Room>
void TreeWalk<Real, Room>::searchLeaf(std::size_t corner, SiteTree::Range range, Deepest& deepest) {
  for (auto rank = range.begin; rank < range.end; ++rank) {
    const auto d = offsetToRank(rank);
    const Real depth = depthOf(corner, d);
    const Real noise = noiseOf(corner, d);
    if (depth > noise && depth > deepest.depth) {
      deepest = {depth, rank, true};
    } else if (!deepest.found && depth >= -noise && !isCornerOf(corner, tree_.site[rank]) &&
               mayMatter(corner, d)) {
      doubtful_.push_back(tree_.site[rank]);
    }
  }
}

template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::isCornerOf(std::size_t corner, std::uint32_t site) const {
  const auto line = static_cast<std::int32_t>(site);
  return cell_.line[corner_[corner].before] == line || cell_.line[corner_[corner].after] == line;
}

template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::isEdge(std::uint32_t site) const {
  for (std::size_t k = 0; k < Room; ++k) {
    if (cell_.line[k] == static_cast<std::int32_t>(site) && cell_.lo[k] < cell_.hi[k]) return true;
  }
  return false;
}

/// Cuts by the sites that were left out as ties, but cut now that the corners are known more precisely.
/// False if most_rounds were not enough.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::cutByDoubtful() {
  for (int round = 0; round < most_rounds; ++round) {
    bool changed = false;
    for (const auto site : doubtful_) {
      if (isOver()) return true;
      if (isEdge(site)) continue;
      bool perhaps = false;
      bool wholly = false;
      const auto d = offsetTo(site);
      if (!isCut(d, perhaps, wholly)) continue;
      surely_empty_ = wholly;
      cut(d, static_cast<std::int32_t>(site));
      changed = true;
    }
    if (!changed) return true;
  }
  return false;
}

/// The distance between the sites of an edge, or between a site and its image behind a wall.
template <class Real, std::size_t Room>
Real TreeWalk<Real, Room>::apart(std::size_t slot) const {
  if (cell_.line[slot] >= 0) return apart_[slot];
  return Real(2.0) *
         abs(cell_.h[slot] - (origin_offset_.x * cell_.nx[slot] + origin_offset_.y * cell_.ny[slot]));
}

template <class Real, std::size_t Room>
CellStatus TreeWalk<Real, Room>::finish(Found<Real>& found) {
  const bool settled = cutByDoubtful();
  if (hasWeights()) found.tried.insert(found.tried.end(), doubtful_.begin(), doubtful_.end());
  if (cell_.overflow) return CellStatus::overflow;
  found.sure = found.sure && settled && (corners_ > 0 || surely_empty_);
  if (corners_ == 0) return CellStatus::empty;
  if (!isKnownAround()) return CellStatus::unsecured;
  for (const auto site : doubtful_) {
    if (hasWeights() && !std::is_floating_point_v<Real> && !isEdge(site)) takeOver(site);
  }
  for (const auto site : doubtful_) {
    if (isEdge(site)) continue;
    const auto d = offsetTo(site);
    for (std::size_t c = 0; c < corners_; ++c) found.sure = !mayMatter(c, d) && found.sure;
  }
  for (std::size_t k = 0; k < Room; ++k) {
    if (!(cell_.lo[k] < cell_.hi[k]) || cell_.line[k] == inner_wall) continue;
    found.edges.push_back({cell_.line[k], cell_.nx[k], cell_.ny[k], cell_.h[k], cell_.lo[k], cell_.hi[k],
                           angle_[k], moved_[k], apart(k)});
  }
  found.blur = max(found.blur, blur_);
  return CellStatus::certified;
}

}  // namespace vorpipe::cpu
