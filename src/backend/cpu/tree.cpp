#include "backend/cpu/tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace vorpipe::cpu {
namespace {

constexpr std::uint32_t leaf_sites = 6;
/// Levels whose nodes are split on all threads, one level after the other; below, a thread splits a subtree.
constexpr std::uint32_t shared_levels = 6;
/// The number of sites that the direction of a box is estimated from.
constexpr std::uint32_t sampled_sites = 32;
/// A box is turned if its sites are at least this elongated: 0 if they vary as much in all directions, 1 if
/// they lie on a line.
constexpr double long_enough = 0.9;
/// A circle is kept if the distances of the sites from its center differ by at most this part of the box's
/// shorter side.
constexpr double round_enough = 0.1;
constexpr std::size_t tree_grain = std::size_t{1} << 14;

double squareOf(double value) { return value * value; }

struct Placed {
  double x, y;
  std::uint32_t site;
};

struct TreeBuilder {
  SiteTree& tree;
  std::vector<Placed>& sites;
  const std::vector<double>& weight;  ///< by index in the set: weightsThatCount(); empty without weights

  [[nodiscard]] Box boxOf(SiteTree::Range range) const {
    constexpr double far = std::numeric_limits<double>::infinity();
    Box box{far, far, -far, -far};
    for (auto p = range.begin; p < range.end; ++p) {
      box.xmin = std::min(box.xmin, sites[p].x);
      box.ymin = std::min(box.ymin, sites[p].y);
      box.xmax = std::max(box.xmax, sites[p].x);
      box.ymax = std::max(box.ymax, sites[p].y);
    }
    return box;
  }

  /// Puts the half of the sites with the lower coordinates first.
  void split(std::uint32_t node, SiteTree::Range range) const {
    if (tree.isLeaf(node)) return;
    const auto box = boxOf(range);
    const auto at = [&](std::uint32_t p) { return sites.begin() + static_cast<std::ptrdiff_t>(p); };
    if (box.xmax - box.xmin >= box.ymax - box.ymin) {
      std::nth_element(at(range.begin), at(range.middle()), at(range.end),
                       [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.site < b.site; });
    } else {
      std::nth_element(at(range.begin), at(range.middle()), at(range.end),
                       [](const auto& a, const auto& b) { return a.y != b.y ? a.y < b.y : a.site < b.site; });
    }
  }

  /// An empty box in the direction in which the sites of `range` extend most, estimated from sampled_sites.
  [[nodiscard]] Bounds turn(SiteTree::Range range) const {
    const auto stride = std::max(1U, (range.end - range.begin) / sampled_sites);
    const auto& origin = sites[range.begin];
    double count = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (auto p = range.begin; p < range.end; p += stride) {
      const double dx = sites[p].x - origin.x;
      const double dy = sites[p].y - origin.y;
      count += 1;
      x += dx;
      y += dy;
      xx += dx * dx;
      xy += dx * dy;
      yy += dy * dy;
    }
    // [p q; q -p] is the covariance matrix minus a multiple of the identity.
    const double p = 0.5 * ((xx - x * x / count) - (yy - y * y / count));
    const double q = xy - x * y / count;
    const double length = std::sqrt(p * p + q * q);
    // A box around boxes of other directions is loose, so that only clearly elongated ones are turned.
    const bool is_long = length > long_enough * 0.5 * ((xx - x * x / count) + (yy - y * y / count));
    const double ux = p >= 0 ? length + p : std::abs(q);
    const double uy = p >= 0 ? q : std::copysign(length - p, q);
    const double norm = std::sqrt(ux * ux + uy * uy);
    constexpr double far = std::numeric_limits<double>::infinity();
    const bool turned = is_long && norm > 0 && std::isfinite(norm);
    return {origin.x, origin.y, turned ? ux / norm : 1, turned ? uy / norm : 0, far, -far, far, -far, 0, 0,
            0,        0};
  }

  static void include(Bounds& box, double dx, double dy) {
    const double a = dx * box.ux + dy * box.uy;
    const double b = dy * box.ux - dx * box.uy;
    const double rounding = 1e-15 * (std::abs(dx) + std::abs(dy));
    box.low_a = std::min(box.low_a, a - rounding);
    box.high_a = std::max(box.high_a, a + rounding);
    box.low_b = std::min(box.low_b, b - rounding);
    box.high_b = std::max(box.high_b, b + rounding);
  }

  /// Adds the circle through three sites of `range` to the bounds, if all sites are nearly on it.
  void fitCircle(Bounds& bounds, SiteTree::Range range) const {
    const auto at = [&](std::uint32_t p) { return Point{sites[p].x - bounds.x, sites[p].y - bounds.y}; };
    const auto b = at(range.middle());
    const auto c = at(range.end - 1);
    const double cross = 2 * (b.x * c.y - b.y * c.x);
    const double bb = b.x * b.x + b.y * b.y;
    const double cc = c.x * c.x + c.y * c.y;
    const Point center{(c.y * bb - b.y * cc) / cross, (b.x * cc - c.x * bb) / cross};
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    const auto measure = [&](std::uint32_t stride) {
      for (auto p = range.begin; p < range.end; p += stride) {
        const auto d = at(p);
        const double distance = std::sqrt(squareOf(d.x - center.x) + squareOf(d.y - center.y));
        least = std::min(least, distance);
        most = std::max(most, distance);
      }
      const double across = std::min(bounds.high_a - bounds.low_a, bounds.high_b - bounds.low_b);
      return std::isfinite(most) && most - least <= round_enough * across;
    };
    if (!measure(std::max(1U, (range.end - range.begin) / sampled_sites)) || !measure(1)) return;
    bounds.center_x = center.x;
    bounds.center_y = center.y;
    bounds.radius = std::max(least - 4e-15 * most, 0.0);
  }

  /// Bounds a node by its sites, or if they are many, by the boxes of its children.
  void bound(std::uint32_t node, SiteTree::Range range) const {
    auto box = turn(range);
    if (tree.isLeaf(node) || range.end - range.begin <= sampled_sites) {
      for (auto p = range.begin; p < range.end; ++p) include(box, sites[p].x - box.x, sites[p].y - box.y);
    } else {
      const std::size_t first = std::size_t{node} * 2;
      for (const auto& child : {tree.bounds[first], tree.bounds[first + 1]}) {
        for (const double a : {child.low_a, child.high_a}) {
          for (const double b : {child.low_b, child.high_b}) {
            include(box, child.x - box.x + child.ux * a - child.uy * b,
                    child.y - box.y + child.uy * a + child.ux * b);
          }
        }
      }
    }
    if (range.end - range.begin >= 3) fitCircle(box, range);
    if (!weight.empty()) box.heaviest = heaviestOf(node, range);
    tree.bounds[node] = box;
  }

  [[nodiscard]] double heaviestOf(std::uint32_t node, SiteTree::Range range) const {
    if (!tree.isLeaf(node)) {
      const std::size_t first = std::size_t{node} * 2;
      return std::max(tree.bounds[first].heaviest, tree.bounds[first + 1].heaviest);
    }
    auto heaviest = weight[sites[range.begin].site];
    for (auto p = range.begin; p < range.end; ++p) heaviest = std::max(heaviest, weight[sites[p].site]);
    return heaviest;
  }

  /// Bounds the nodes before the node `end`, children first.
  void boundAbove(std::uint32_t node, SiteTree::Range range, std::uint32_t end) const {
    if (node >= end) return;
    boundAbove(2 * node, {range.begin, range.middle()}, end);
    boundAbove(2 * node + 1, {range.middle(), range.end}, end);
    bound(node, range);
  }

  void splitBelow(std::uint32_t node, SiteTree::Range range) const {
    split(node, range);
    if (tree.isLeaf(node)) {
      bound(node, range);
      return;
    }
    splitBelow(2 * node, {range.begin, range.middle()});
    splitBelow(2 * node + 1, {range.middle(), range.end});
    bound(node, range);
  }
};

/// Returns the weights, with the least of all for heavy sites: TreeWalk cuts every cell by those first, so
/// they need no wide bounds.
std::vector<double> weightsThatCount(const SiteSet& sites) {
  auto weight = sites.weight;
  if (sites.heavy.empty()) return weight;
  const auto least = *std::min_element(weight.begin(), weight.end());
  for (const auto heavy : sites.heavy) weight[heavy] = least;
  return weight;
}

}  // namespace

SiteTree::SiteTree(const SiteSet& sites, int threads) {
  const auto count = static_cast<std::uint32_t>(sites.size());
  assert(count > 0);
  while ((count + first_leaf - 1) / first_leaf > leaf_sites) first_leaf *= 2;
  bounds.resize(2 * std::size_t{first_leaf});
  std::vector<Placed> placed(count);
  parallelEach(count, tree_grain, threads, [&](std::size_t i) {
    placed[i] = {sites.x[i], sites.y[i], static_cast<std::uint32_t>(i)};
  });
  const auto counted = weightsThatCount(sites);
  const TreeBuilder builder{*this, placed, counted};
  std::vector<Range> ranges{{0, count}};
  for (std::uint32_t level = 0; level < shared_levels && ranges.size() < first_leaf; ++level) {
    parallelFor(ranges.size(), 1, threads, [&](std::size_t n, std::size_t) {
      builder.split(static_cast<std::uint32_t>(ranges.size() + n), ranges[n]);
    });
    std::vector<Range> halves;
    for (const auto& range : ranges) {
      halves.push_back({range.begin, range.middle()});
      halves.push_back({range.middle(), range.end});
    }
    ranges = std::move(halves);
  }
  parallelFor(ranges.size(), 1, threads, [&](std::size_t n, std::size_t) {
    builder.splitBelow(static_cast<std::uint32_t>(ranges.size() + n), ranges[n]);
  });
  builder.boundAbove(1, {0, count}, static_cast<std::uint32_t>(ranges.size()));
  site.resize(count);
  rank.resize(count);
  x.resize(count);
  y.resize(count);
  weight.resize(sites.weight.size());
  parallelEach(count, tree_grain, threads, [&](std::size_t p) {
    site[p] = placed[p].site;
    rank[placed[p].site] = static_cast<std::uint32_t>(p);
    x[p] = placed[p].x;
    y[p] = placed[p].y;
    if (!weight.empty()) weight[p] = sites.weight[placed[p].site];
  });
}

}  // namespace vorpipe::cpu
