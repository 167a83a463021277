#include "core/corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "parallel.h"

namespace vorpipe {
namespace {

constexpr std::size_t grain = 4096;
constexpr double shortest_edge = 1e-6;
constexpr std::uint64_t none = ~std::uint64_t{0};

double length(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }

bool isVerticalWall(std::int64_t wall) { return wall == wall_xmin || wall == wall_xmax; }

double wallPlace(const Box& domain, std::int64_t wall) {
  if (wall == wall_xmin) return domain.xmin;
  if (wall == wall_xmax) return domain.xmax;
  return wall == wall_ymin ? domain.ymin : domain.ymax;
}

/// 1, 2, 4, 8 for xmin, xmax, ymin, ymax; 0 for a site.
std::uint8_t wallBit(std::int64_t neighbor) {
  return neighbor < 0 ? static_cast<std::uint8_t>(1 << (-neighbor - 1)) : std::uint8_t{0};
}

double siteDistance(const SiteSet& s, std::size_t i, std::size_t j) {
  return std::hypot(s.x[j] - s.x[i], s.y[j] - s.y[i]);
}

/// The center of the circle through three sites, from the differences to the one that lies opposite
/// their longest side: of two sites side by side and one far away, the differences stay exact.
Point circumcenter(const SiteSet& s, std::int64_t a, std::int64_t b, std::int64_t c) {
  auto i = static_cast<std::size_t>(a);
  auto j = static_cast<std::size_t>(b);
  auto k = static_cast<std::size_t>(c);
  const double ij = siteDistance(s, i, j);
  const double jk = siteDistance(s, j, k);
  const double ik = siteDistance(s, i, k);
  if (ik > jk && ik >= ij) {
    std::swap(i, j);
  } else if (ij > jk) {
    std::swap(i, k);
  }
  const double bx = s.x[j] - s.x[i];
  const double by = s.y[j] - s.y[i];
  const double cx = s.x[k] - s.x[i];
  const double cy = s.y[k] - s.y[i];
  const double twice = 2 * (bx * cy - by * cx);
  const double bb = bx * bx + by * by;
  const double cc = cx * cx + cy * cy;
  return {s.x[i] + (cy * bb - by * cc) / twice, s.y[i] + (bx * cc - cx * bb) / twice};
}

/// Where the bisector of two sites meets a wall.
Point atWall(const SiteSet& s, std::int64_t a, std::int64_t b, std::int64_t wall) {
  const auto i = static_cast<std::size_t>(a);
  const auto j = static_cast<std::size_t>(b);
  const double dx = s.x[j] - s.x[i];
  const double dy = s.y[j] - s.y[i];
  const double half = 0.5 * (dx * dx + dy * dy);
  const double place = wallPlace(s.domain, wall);
  if (isVerticalWall(wall)) return {place, s.y[i] + (half - (place - s.x[i]) * dx) / dy};
  return {s.x[i] + (half - (place - s.y[i]) * dy) / dx, place};
}

/// The position of the corner of `cell` between its neighbors `before` and `after`.
Point cornerPosition(const SiteSet& s, std::int64_t cell, std::int64_t before, std::int64_t after) {
  if (before < 0 && after < 0) {
    const auto vertical = isVerticalWall(before) ? before : after;
    const auto level = isVerticalWall(before) ? after : before;
    return {wallPlace(s.domain, vertical), wallPlace(s.domain, level)};
  }
  const auto earlier = [&](std::int64_t a, std::int64_t b) {
    return s.id[static_cast<std::size_t>(a)] < s.id[static_cast<std::size_t>(b)];
  };
  if (before < 0 || after < 0) {
    const auto other = std::max(before, after);
    const auto wall = std::min(before, after);
    return earlier(cell, other) ? atWall(s, cell, other, wall) : atWall(s, other, cell, wall);
  }
  std::array<std::int64_t, 3> sorted{cell, before, after};
  std::sort(sorted.begin(), sorted.end(), earlier);
  return circumcenter(s, sorted[0], sorted[1], sorted[2]);
}

/// Disjoint sets of corners; the root of a set is its lowest corner, whatever the order of joining.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    for (std::size_t i = 0; i < count; ++i) parent_[i] = i;
  }
  std::uint64_t root(std::uint64_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint64_t a, std::uint64_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint64_t> parent_;
};

/// The same edge as its other cell has it, or `none`.
std::uint64_t reverseOf(const Topology& topology, std::int64_t cell, std::int64_t neighbor) {
  if (neighbor < 0) return none;
  const auto other = static_cast<std::size_t>(neighbor);
  for (auto e = topology.first[other]; e < topology.first[other + 1]; ++e) {
    if (topology.neighbor[e] == cell) return e;
  }
  return none;
}

class Agreeing {
 public:
  Agreeing(const SiteSet& sites, const Topology& topology, int threads)
      : sites_(sites), topology_(topology), threads_(threads), sets_(topology.neighbor.size()) {
    const auto edges = topology.neighbor.size();
    reverse_.resize(edges);
    short_.resize(edges);
    walls_.resize(edges);
    corners_.position.resize(edges);
    corners_.next.resize(edges);
    corners_.tie.resize(edges);
    disputed_.resize(sites.size());
  }

  Agreement run() {
    forCells([&](std::size_t cell) { placeCorners(cell); });
    forCells([&](std::size_t cell) { compareEdges(cell); });
    for (std::size_t cell = 0; cell < sites_.size(); ++cell) joinCorners(cell);
    corners_.root.resize(corners_.position.size());
    for (std::uint64_t c = 0; c < corners_.root.size(); ++c) corners_.root[c] = sets_.root(c);
    takeSharedPositions();
    Agreement agreement{std::move(corners_), {}};
    for (std::uint32_t cell = 0; cell < disputed_.size(); ++cell) {
      if (disputed_[cell]) agreement.disputed.push_back(cell);
    }
    return agreement;
  }

 private:
  template <class Work>
  void forCells(const Work& work) {
    parallelFor(sites_.size(), grain, threads_, [&](std::size_t begin, std::size_t end) {
      for (auto cell = begin; cell < end; ++cell) work(cell);
    });
  }

  void placeCorners(std::size_t cell) {
    const auto begin = topology_.first[cell];
    const auto end = topology_.first[cell + 1];
    for (auto e = begin; e < end; ++e) {
      const auto before = e > begin ? e - 1 : end - 1;
      corners_.next[e] = e + 1 < end ? e + 1 : begin;
      corners_.position[e] = cornerPosition(sites_, static_cast<std::int64_t>(cell),
                                            topology_.neighbor[before], topology_.neighbor[e]);
      walls_[e] = wallBit(topology_.neighbor[before]) | wallBit(topology_.neighbor[e]);
      reverse_[e] = reverseOf(topology_, static_cast<std::int64_t>(cell), topology_.neighbor[e]);
    }
  }

  /// Every corner of a vertex takes the same position: the domain's corner if walls of both directions
  /// meet in the vertex, else that of a corner on a wall, so that ties do not pull the domain's border
  /// inward; else that of the root.
  void takeSharedPositions() {
    std::vector<std::uint64_t> chosen = corners_.root;
    std::vector<std::uint8_t> walls(chosen.size());
    for (std::uint64_t c = 0; c < chosen.size(); ++c) {
      const auto root = corners_.root[c];
      if (walls_[c] != 0 && walls[root] == 0) chosen[root] = c;
      walls[root] |= walls_[c];
    }
    const auto own = corners_.position;
    for (std::uint64_t c = 0; c < chosen.size(); ++c) {
      const auto root = corners_.root[c];
      const auto vertical = (walls[root] & 1) ? wall_xmin : wall_xmax;
      const auto level = (walls[root] & 4) ? wall_ymin : wall_ymax;
      const bool both = (walls[root] & 3) && (walls[root] & 12);
      corners_.position[c] = both ? Point{wallPlace(sites_.domain, vertical), wallPlace(sites_.domain, level)}
                                  : own[chosen[root]];
    }
  }

  [[nodiscard]] double neighborDistance(std::size_t cell, std::int64_t neighbor) const {
    if (neighbor < 0) {
      const double along = isVerticalWall(neighbor) ? sites_.x[cell] : sites_.y[cell];
      return 2 * std::abs(wallPlace(sites_.domain, neighbor) - along);
    }
    return siteDistance(sites_, cell, static_cast<std::size_t>(neighbor));
  }

  [[nodiscard]] double edgeLength(std::uint64_t e) const {
    return length(corners_.position[e], corners_.position[corners_.next[e]]);
  }

  /// Notes which edges are short, and which are neither short nor known to the other cell, or end
  /// elsewhere there.
  void compareEdges(std::size_t cell) {
    for (auto e = topology_.first[cell]; e < topology_.first[cell + 1]; ++e) {
      const auto neighbor = topology_.neighbor[e];
      const double shortest = shortest_edge * neighborDistance(cell, neighbor);
      const auto back = reverse_[e];
      short_[e] = edgeLength(e) <= shortest || (back != none && edgeLength(back) <= shortest);
      if (short_[e] || neighbor < 0) continue;
      const bool agreed = back != none &&
                          length(corners_.position[e], corners_.position[corners_.next[back]]) < shortest &&
                          length(corners_.position[corners_.next[e]], corners_.position[back]) < shortest;
      if (!agreed) disputed_[cell] = 1;
    }
  }

  void joinCorners(std::size_t cell) {
    for (auto e = topology_.first[cell]; e < topology_.first[cell + 1]; ++e) {
      if ((disputed_[cell] & 1) && topology_.neighbor[e] >= 0) {
        disputed_[static_cast<std::size_t>(topology_.neighbor[e])] |= 2;
      }
      corners_.tie[e] = short_[e] != 0;
      if (short_[e]) sets_.join(e, corners_.next[e]);
      if (reverse_[e] == none) continue;
      sets_.join(e, corners_.next[reverse_[e]]);
      sets_.join(corners_.next[e], reverse_[e]);
    }
  }

  const SiteSet& sites_;
  const Topology& topology_;
  int threads_;
  Sets sets_;
  Corners corners_;
  std::vector<std::uint64_t> reverse_;
  std::vector<std::uint8_t> short_;
  std::vector<std::uint8_t> walls_;  ///< bits of the walls that a corner is on
  std::vector<std::uint8_t> disputed_;
};

}  // namespace

Agreement agreeOnCorners(const SiteSet& sites, const Topology& topology, int threads) {
  return Agreeing(sites, topology, threads).run();
}

}  // namespace vorpipe
