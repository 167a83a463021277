#include "space/exact_cell.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "space/place.h"
#include "space/predicates.h"

namespace vorpipe::space {
namespace {

/// Beyond, blocks of vertices are tested as one; edges are paired by sorting.
constexpr std::size_t vertices_of_large = 256, removed_of_large = 16;

std::uint64_t edge(Label a, Label b) {
  return std::uint64_t{static_cast<std::uint32_t>(a)} << 32 | static_cast<std::uint32_t>(b);
}
Label firstOf(std::uint64_t edge) { return static_cast<Label>(edge >> 32); }
Label secondOf(std::uint64_t edge) { return static_cast<Label>(edge & 0xffffffff); }
/// The same edge as its other end names it.
std::uint64_t reversed(std::uint64_t edge) { return std::rotl(edge, 32); }

}  // namespace

ExactCell::ExactCell(const Places& places, Label site) : places_(places) { reset(site); }

void ExactCell::reset(Label site) {
  site_ = site;
  label_.clear();
  spot_.clear();
  blocks_.reset();
  squared_radius_ = -1;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    std::array<Label, 3> label{labelOfWall(x), labelOfWall(2 + y), labelOfWall(4 + z)};
    // Where an odd number of walls are upper ones their normals turn as the axes do.
    if ((x + y + z) % 2 == 0) std::swap(label[0], label[1]);
    label_.push_back(label);
    spot_.push_back(spotOf(label));
  }
}

VertexSpot ExactCell::spotOf(const std::array<Label, 3>& label) const {
  const auto& [a, b, c] = label;
  const PlaceInDouble quick(relative(places_, site_, a), relative(places_, site_, b),
                            relative(places_, site_, c));
  Point3 p = quick.place;
  double error = quick.error, distance = quick.distance;
  if (error == HUGE_VAL) {
    p = vertexPlace(places_, site_, a, b, c, &error);
    distance = std::hypot(p.x, p.y, p.z);
  }
  const double far = distance * (1 + 0x1p-48) + error;
  return {p.x, p.y, p.z, error + 0x1p-50 * distance, far * far};
}

bool ExactCell::cut(Label by) {
  findRemoved(by);
  if (removed_.empty()) return false;
  squared_radius_ = -1;
  if (removed_.size() == label_.size()) {
    noteEmpty(by);
    label_.clear();
    spot_.clear();
    blocks_.reset();
    return true;
  }
  findRim();
  replaceRemoved(by);
  if (label_.size() > vertices_of_large && (!blocks_ || blocks_->isWorn())) blocks_.emplace(spot_);
  return true;
}

void ExactCell::findRemoved(Label by) {
  removed_.clear();
  const HalfSpace half_space(relative(places_, site_, by));
  candidates_.clear();
  if (blocks_) {
    blocks_->find(half_space, candidates_);
  } else {
    candidates_.resize(label_.size());
    std::iota(candidates_.begin(), candidates_.end(), 0U);
  }
  // Nearly all are below; which are not cannot be foreseen.
  std::size_t kept = 0;
  for (const std::uint32_t v : candidates_) {
    const VertexSpot& spot = spot_[v];
    const bool below = half_space.above(spot.x, spot.y, spot.z) < -half_space.error(spot.slack);
    candidates_[kept] = v;
    kept += below ? 0 : 1;
  }
  candidates_.resize(kept);
  for (const std::uint32_t v : candidates_) {
    const VertexSpot& spot = spot_[v];
    if (!(half_space.above(spot.x, spot.y, spot.z) > half_space.error(spot.slack))) {
      const auto& [a, b, c] = label_[v];
      if (a == by || b == by || c == by || !cuts(places_, site_, a, b, c, by)) continue;
    }
    removed_.push_back(v);
  }
  if (blocks_) std::ranges::sort(removed_);
}

/// Of what is left there is a vertex that no other is nearer than to the plane that cuts everything off.
void ExactCell::noteEmpty(Label by) {
  const HalfSpace half_space(relative(places_, site_, by));
  const auto far = [&](const VertexSpot& spot) { return half_space.above(spot.x, spot.y, spot.z); };
  const auto take = [&](const std::array<Label, 3>& label) {
    emptied_by_ = {label[0], label[1], label[2], by};
    return isNearestVertex(places_, site_, emptied_by_);
  };
  const auto nearest = std::ranges::min_element(spot_, {}, far) - spot_.begin();
  if (take(label_[static_cast<std::size_t>(nearest)])) return;
  std::ranges::any_of(label_, take);
}

/// The edges of removed vertices that no other removed vertex has; each named as its end that goes names it.
void ExactCell::findRim() {
  edges_.clear();
  rim_.clear();
  for (const std::uint32_t v : removed_) {
    const auto& [a, b, c] = label_[v];
    edges_.insert(edges_.end(), {edge(a, b), edge(b, c), edge(c, a)});
  }
  if (removed_.size() <= removed_of_large) {
    for (const Edge e : edges_) {
      bool again = false;
      for (const Edge other : edges_) again |= other == reversed(e);
      if (!again) rim_.push_back(e);
    }
    return;
  }
  const auto whole = [](Edge e) { return std::min(e, reversed(e)); };
  std::ranges::sort(edges_, {}, whole);
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    if (k + 1 < edges_.size() && whole(edges_[k]) == whole(edges_[k + 1])) {
      ++k;
    } else {
      rim_.push_back(edges_[k]);
    }
  }
}

/// The end of edge (a, b) that stays is (b, a, ...), so that the new vertex is (a, b, by).
void ExactCell::replaceRemoved(Label by) {
  const std::size_t gone = removed_.size();
  for (std::size_t k = 0; k < rim_.size(); ++k) {
    const std::array<Label, 3> label{firstOf(rim_[k]), secondOf(rim_[k]), by};
    const VertexSpot spot = spotOf(label);
    if (k < gone) {
      label_[removed_[k]] = label;
      spot_[removed_[k]] = spot;
      if (blocks_) blocks_->move(removed_[k]);
    } else {
      label_.push_back(label);
      spot_.push_back(spot);
      if (blocks_) blocks_->append(removed_.back());
    }
  }
  for (std::size_t k = gone; k > rim_.size(); --k) {
    const std::uint32_t v = removed_[k - 1];
    if (blocks_) blocks_->replaceByLast(v);
    label_[v] = label_.back();
    spot_[v] = spot_.back();
    label_.pop_back();
    spot_.pop_back();
  }
  if (blocks_) blocks_->update(spot_);
}

double ExactCell::squaredRadius() const {
  if (squared_radius_ < 0) {
    squared_radius_ = 0;
    if (blocks_) squared_radius_ = blocks_->largestSquared();
    if (!blocks_) {
      for (const VertexSpot& spot : spot_) squared_radius_ = std::max(squared_radius_, spot.squared);
    }
  }
  return squared_radius_;
}

}  // namespace vorpipe::space
