/// Cells by brute force, in rational numbers.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <vector>

#include "backend/backend.h"

namespace vorpipe {

using Rational = boost::multiprecision::cpp_rational;

/// A site with its weight, or 0 where sites have none.
struct WeightedSite {
  double x, y, weight;

  WeightedSite(const SiteSet& set, std::size_t i)
      : x(set.x[i]), y(set.y[i]), weight(set.weight.empty() ? 0 : set.weight[i]) {}
};

/// A part of the cell of a site: a convex polygon; edge k runs from corner k on and belongs to neighbor k.
struct RationalCell {
  struct Corner {
    Rational x, y;
  };
  WeightedSite site;
  std::vector<Corner> corner;
  std::vector<std::int32_t> neighbor;
  std::vector<double> apart;  ///< squared distance of the site to that neighbor; infinite for a wall
  std::vector<Point> offset;  ///< of the corners from the site, in double

  RationalCell(const Box& box, const WeightedSite& of)
      : site(of),
        corner{{box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}},
        neighbor{-3, -2, -4, -1},
        apart(4, std::numeric_limits<double>::infinity()) {
    findOffsets();
  }

  void findOffsets() {
    offset.clear();
    for (const auto& p : corner) {
      offset.push_back(
          {static_cast<double>(p.x - Rational(site.x)), static_cast<double>(p.y - Rational(site.y))});
    }
  }

  /// Whether every corner is nearer to the cell's site than to another, by so much that doubles tell.
  [[nodiscard]] bool isClearlyNearerThan(const WeightedSite& other) const {
    const double dx = other.x - site.x;
    const double dy = other.y - site.y;
    const double weight_difference = site.weight - other.weight;
    return std::all_of(offset.begin(), offset.end(), [&](const Point& p) {
      const double along = 2 * (p.x * dx + p.y * dy);
      const double squared = dx * dx + dy * dy;
      const double all =
          2 * (std::abs(p.x * dx) + std::abs(p.y * dy)) + squared + std::abs(weight_difference);
      return along - squared - weight_difference < -1e-9 * all;
    });
  }

  [[nodiscard]] bool hasArea() const {
    Rational twice = 0;
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const auto& p = corner[k];
      const auto& q = corner[(k + 1) % corner.size()];
      twice += p.x * q.y - p.y * q.x;
    }
    return twice > 0;
  }

  /// Keeps what is nearer to the cell's site than to another. Where the bisectors with two sites lie in one
  /// line, the edge is that of the farther: beyond that line the nearer has no cell.
  void cut(const WeightedSite& other, std::int32_t line) {
    const Rational ax = site.x;
    const Rational ay = site.y;
    const Rational bx = other.x;
    const Rational by = other.y;
    const Rational weight_difference = Rational(site.weight) - Rational(other.weight);
    const auto excess = [&](const Corner& p) {
      return Rational((2 * p.x - ax - bx) * (bx - ax) + (2 * p.y - ay - by) * (by - ay) - weight_difference);
    };
    std::vector<Corner> kept;
    std::vector<std::int32_t> lines;
    std::vector<double> distances;
    const double squared = (other.x - site.x) * (other.x - site.x) + (other.y - site.y) * (other.y - site.y);
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const auto& p = corner[k];
      const auto& q = corner[(k + 1) % corner.size()];
      const auto at_p = excess(p);
      const auto at_q = excess(q);
      const bool is_new =
          (at_p < 0 && at_q > 0) || (at_p == 0 && (at_q > 0 || (at_q == 0 && squared > apart[k])));
      if (at_p <= 0) {
        kept.push_back(p);
        lines.push_back(at_p == 0 && is_new ? line : neighbor[k]);
        distances.push_back(at_p == 0 && is_new ? squared : apart[k]);
      }
      if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
        const Rational t = at_p / (at_p - at_q);
        kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
        lines.push_back(is_new ? line : neighbor[k]);
        distances.push_back(is_new ? squared : apart[k]);
      }
    }
    corner = std::move(kept);
    neighbor = std::move(lines);
    apart = std::move(distances);
    findOffsets();
  }
};

/// The part of the domain that is nearer to a site than to any of `others`, which may hold walls.
inline RationalCell cellByBruteForce(const SiteSet& set, std::uint32_t site,
                                     std::span<const std::int32_t> others) {
  RationalCell cell(set.domain, {set, site});
  for (const auto other : others) {
    if (other < 0) continue;
    const WeightedSite that(set, static_cast<std::size_t>(other));
    if (!cell.isClearlyNearerThan(that)) cell.cut(that, other);
  }
  return cell;
}

/// The squared length of a cell's edges over the squared distance of their sites, by neighbor; 0 for what
/// only touches the cell, or nearly so.
inline std::map<std::int32_t, double> edgesByBruteForce(const SiteSet& set, std::uint32_t site) {
  const WeightedSite self(set, site);
  const Rational x = self.x;
  const Rational y = self.y;
  std::vector<std::int32_t> others(set.size());
  std::iota(others.begin(), others.end(), 0);
  others.erase(others.begin() + site);
  std::sort(others.begin(), others.end(), [&](auto a, auto b) {
    const auto power = [&](std::int32_t i) {
      const WeightedSite other(set, static_cast<std::size_t>(i));
      return (other.x - self.x) * (other.x - self.x) + (other.y - self.y) * (other.y - self.y) - other.weight;
    };
    return power(a) < power(b);
  });
  const auto cell = cellByBruteForce(set, site, others);
  std::map<std::int32_t, double> edges;
  if (!cell.hasArea()) return edges;
  for (std::size_t k = 0; k < cell.corner.size(); ++k) {
    const auto& p = cell.corner[k];
    const auto& q = cell.corner[(k + 1) % cell.corner.size()];
    const Rational length = (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
    const auto line = cell.neighbor[k];
    Rational dx = 0;
    Rational dy = 0;
    if (line >= 0) {
      dx = Rational(set.x[static_cast<std::size_t>(line)]) - x;
      dy = Rational(set.y[static_cast<std::size_t>(line)]) - y;
    } else if (line >= -2) {
      dx = 2 * (Rational(line == -1 ? set.domain.xmin : set.domain.xmax) - x);
    } else {
      dy = 2 * (Rational(line == -3 ? set.domain.ymin : set.domain.ymax) - y);
    }
    const Rational distance = dx * dx + dy * dy;
    if (distance != 0) edges[line] = static_cast<double>(length / distance);
  }
  for (const auto other : others) {
    if (!cell.isClearlyNearerThan({set, static_cast<std::size_t>(other)})) edges.emplace(other, 0);
  }
  for (const auto& p : cell.corner) {
    const auto touches = [](const Rational& at, double wall) {
      return std::abs(static_cast<double>(at - Rational(wall))) < 1e-9;
    };
    if (touches(p.x, set.domain.xmin)) edges.emplace(-1, 0);
    if (touches(p.x, set.domain.xmax)) edges.emplace(-2, 0);
    if (touches(p.y, set.domain.ymin)) edges.emplace(-3, 0);
    if (touches(p.y, set.domain.ymax)) edges.emplace(-4, 0);
  }
  return edges;
}

}  // namespace vorpipe
