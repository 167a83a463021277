/// Cells by brute force, in rational numbers.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "backend/backend.h"

namespace vorpipe {

using Rational = boost::multiprecision::cpp_rational;

/// A convex polygon; edge k runs from corner k on and belongs to neighbor k.
struct RationalCell {
  struct Corner {
    Rational x, y;
  };
  std::vector<Corner> corner;
  std::vector<std::int32_t> neighbor;

  explicit RationalCell(const Box& box)
      : corner{{box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}},
        neighbor{-3, -2, -4, -1} {}

  /// Whether (ax, ay) is nearer to every corner than (bx, by), by so much that doubles tell.
  [[nodiscard]] bool isClearlyInside(double ax, double ay, double bx, double by) const {
    return std::all_of(corner.begin(), corner.end(), [&](const Corner& p) {
      const auto x = static_cast<double>(p.x);
      const auto y = static_cast<double>(p.y);
      return std::hypot(x - ax, y - ay) < std::hypot(x - bx, y - by) * (1 - 1e-9);
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

  /// Keeps what is nearer to (ax, ay) than to (bx, by).
  void cut(const Rational& ax, const Rational& ay, const Rational& bx, const Rational& by,
           std::int32_t site) {
    const auto beyond = [&](const Corner& p) {
      return Rational((2 * p.x - ax - bx) * (bx - ax) + (2 * p.y - ay - by) * (by - ay));
    };
    std::vector<Corner> kept;
    std::vector<std::int32_t> lines;
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const auto& p = corner[k];
      const auto& q = corner[(k + 1) % corner.size()];
      const auto at_p = beyond(p);
      const auto at_q = beyond(q);
      if (at_p <= 0) {
        kept.push_back(p);
        lines.push_back(neighbor[k]);
      }
      if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
        const Rational t = at_p / (at_p - at_q);
        kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
        lines.push_back(at_p < 0 ? site : neighbor[k]);
      } else if (at_p == 0 && at_q > 0) {
        lines.back() = site;
      }
    }
    corner = std::move(kept);
    neighbor = std::move(lines);
  }
};

/// The squared length of a cell's edges over the squared distance of their sites, by neighbor; 0 for what
/// only touches the cell, or nearly so.
inline std::map<std::int32_t, double> edgesByBruteForce(const SiteSet& set, std::uint32_t site) {
  RationalCell cell(set.domain);
  const Rational x = set.x[site];
  const Rational y = set.y[site];
  std::vector<std::uint32_t> others(set.size());
  std::iota(others.begin(), others.end(), 0U);
  std::sort(others.begin(), others.end(), [&](auto a, auto b) {
    const auto distance = [&](auto i) { return std::hypot(set.x[i] - set.x[site], set.y[i] - set.y[site]); };
    return distance(a) < distance(b);
  });
  for (const auto other : others) {
    if (other == site || cell.isClearlyInside(set.x[site], set.y[site], set.x[other], set.y[other])) continue;
    cell.cut(x, y, set.x[other], set.y[other], static_cast<std::int32_t>(other));
  }
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
    if (other == site || cell.isClearlyInside(set.x[site], set.y[site], set.x[other], set.y[other])) continue;
    edges.emplace(static_cast<std::int32_t>(other), 0);
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
