/// Where the sites of a run lie: their scale, and the grid over all of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/inside.h"
#include "sites/grid.h"

namespace vorpipe::core {

inline constexpr double farthest_site = 0x1p300;  ///< in domains

/// Scaled coordinates, of sites and of the domain's walls, are multiples of 2^-200: exact decisions multiply
/// four differences, and a double could not hold the product of smaller ones. All doubles from 2^-148 on are
/// such multiples; values nearer to 0 are rounded to a multiple of 2^-199. Sites that become equal by this
/// would be too near to each other anyway.
inline constexpr double least_coordinate = 0x1p-200;
inline double usableCoordinate(double scaled) {
  constexpr double coarse = 0x1.8p-147;  // adding it rounds off the digits below 2^-199
  return std::abs(scaled) < 0x1p-148 ? (scaled + coarse) - coarse : scaled;
}

/// A domain in scaled units.
Box scaledDomain(const Box& domain, int exponent);

/// The results of one pass over sites, in scaled units.
struct Extent {
  Box box{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::size_t inside = 0;  ///< sites within the box `near`
  bool usable = true;      ///< every coordinate is finite and not too far away

  void add(double x, double y, const Box& near) {
    box = {std::min(box.xmin, x), std::min(box.ymin, y), std::max(box.xmax, x), std::max(box.ymax, y)};
    inside += isInside(near, x, y) ? 1U : 0U;
    usable = usable && std::abs(x) <= farthest_site && std::abs(y) <= farthest_site;
  }
  void add(const Extent& other) {
    const auto& b = other.box;
    box = {std::min(box.xmin, b.xmin), std::min(box.ymin, b.ymin), std::max(box.xmax, b.xmax),
           std::max(box.ymax, b.ymax)};
    inside += other.inside;
    usable = usable && other.usable;
  }
};

/// The power of two that brings the domain's longer side into [1, 2).
int scaleExponent(const Box& domain);

/// Error (input): the domain is not a rectangle.
Result<void> checkDomain(const Box& domain);

/// The domain and as much again on every side: farther sites bound few cells, and would make the bins
/// of the others large.
Box surroundings(const Box& domain);

/// The grid over sites of this extent, which was computed with `near`, the surroundings of the domain.
Grid gridOver(const Extent& extent, const Box& near);

/// The error for site i, whose coordinates (x, y) are not finite or too far away.
Error unusableSite(std::size_t i, double x, double y);

}  // namespace vorpipe::core
