#include "cells/hidden_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "geometry/expansion.h"
#include "geometry/vertex_position.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t hidden_cells_grain = 4096;
/// More than twice the rounding error of a sum of products of a square and two differences, relative to the
/// sum of its terms' magnitudes; and the least such sum for which this holds.
constexpr double relative_error = 4e-15;
constexpr double least_sum = 1e-250;

/// A half-plane, 2 (x, y) . p <= c, with p relative to the site of a cell; `size` is the sum of the
/// magnitudes of c's terms.
struct HalfPlane {
  double x, y, c, size;
  std::int32_t line;  ///< a site or a wall
};

/// The same without rounding.
struct ExactHalfPlane {
  Expansion<2> x, y;
  Expansion<18> c;
};

double crossOf(const HalfPlane& a, const HalfPlane& b) { return a.x * b.y - a.y * b.x; }
double crossSize(const HalfPlane& a, const HalfPlane& b) { return std::abs(a.x * b.y) + std::abs(a.y * b.x); }
Expansion<16> crossOf(const ExactHalfPlane& a, const ExactHalfPlane& b) { return a.x * b.y - a.y * b.x; }

/// The remainder of a cell: the lines of its edges, counter-clockwise, which determine all else. Its area and
/// the length of every edge are positive.
class Remainder {
 public:
  explicit Remainder(const SiteSet& sites) : sites_(sites) {}

  /// Whether the bisectors with the sites among `lines` leave nothing of the domain for a cell.
  bool isNothing(std::uint32_t cell, std::span<const std::int32_t> lines) {
    cell_ = cell;
    edges_.clear();
    for (const auto wall : {wall_xmin, wall_ymin, wall_xmax, wall_ymax}) {
      edges_.push_back(halfPlane(static_cast<std::int32_t>(wall)));
    }
    return std::any_of(lines.begin(), lines.end(), [&](std::int32_t line) {
      const bool other = line >= 0 && static_cast<std::size_t>(line) < sites_.size() &&
                         static_cast<std::uint32_t>(line) != cell;
      return other && !cut(line);
    });
  }

 private:
  /// Cuts off the part beyond a line. Returns false if no area is left.
  bool cut(std::int32_t line) {
    const auto by = halfPlane(line);
    const auto count = edges_.size();
    sides_.resize(count);
    for (std::size_t e = 0; e < count; ++e)
      sides_[e] = sideOf(edges_[e > 0 ? e - 1 : count - 1], edges_[e], by);
    if (std::none_of(sides_.begin(), sides_.end(), [](int side) { return side < 0; })) return false;
    if (std::none_of(sides_.begin(), sides_.end(), [](int side) { return side > 0; })) return true;
    // The vertices on or beyond the line are consecutive.
    std::size_t begin = 0;
    while (!(sides_[begin] >= 0 && sides_[begin > 0 ? begin - 1 : count - 1] < 0)) ++begin;
    std::rotate(edges_.begin(), edges_.begin() + static_cast<std::ptrdiff_t>(begin), edges_.end());
    std::rotate(sides_.begin(), sides_.begin() + static_cast<std::ptrdiff_t>(begin), sides_.end());
    const auto end = std::find_if(sides_.begin(), sides_.end(), [](int side) { return side < 0; });
    // The last of the edges that begin there ends inside.
    edges_.erase(edges_.begin(), edges_.begin() + (end - sides_.begin() - 1));
    edges_.insert(edges_.begin(), by);
    return true;
  }

  [[nodiscard]] HalfPlane halfPlane(std::int32_t line) const {
    if (line < 0) {
      const bool vertical = isVerticalWall(line);
      const double sign = outward(line);
      const double c =
          2 * sign * (wallCoordinate(sites_.domain, line) - (vertical ? sites_.x : sites_.y)[cell_]);
      return {vertical ? sign : 0, vertical ? 0 : sign, c, std::abs(c), line};
    }
    const auto other = static_cast<std::size_t>(line);
    const double x = sites_.x[other] - sites_.x[cell_], y = sites_.y[other] - sites_.y[cell_];
    const double squared = x * x + y * y;
    const double weight_difference = sites_.weight.empty() ? 0 : sites_.weight[cell_] - sites_.weight[other];
    return {x, y, squared + weight_difference, squared + std::abs(weight_difference), line};
  }

  /// The exact half-plane, scaled so that no product leaves a double's range.
  [[nodiscard]] ExactHalfPlane exactly(const HalfPlane& rounded) const {
    ExactHalfPlane exact;
    if (rounded.line < 0) {
      const bool vertical = isVerticalWall(rounded.line);
      exact.x.append(rounded.x);
      exact.y.append(rounded.y);
      const auto way =
          difference(wallCoordinate(sites_.domain, rounded.line), (vertical ? sites_.x : sites_.y)[cell_]);
      for (std::size_t k = 0; k < way.size; ++k) exact.c.append(2 * outward(rounded.line) * way.part[k]);
      return exact;
    }
    const auto other = static_cast<std::size_t>(rounded.line);
    exact.x = difference(sites_.x[other], sites_.x[cell_]);
    exact.y = difference(sites_.y[other], sites_.y[cell_]);
    const auto squared = exact.x * exact.x + exact.y * exact.y;
    exact.c = squared + (sites_.weight.empty() ? Expansion<2>{}
                                               : difference(sites_.weight[cell_], sites_.weight[other]));
    const int exponent = -std::ilogb(std::max(std::abs(rounded.x), std::abs(rounded.y)));
    scale(exact.x, exponent);
    scale(exact.y, exponent);
    scale(exact.c, exponent);
    return exact;
  }

  template <std::size_t most>
  static void scale(Expansion<most>& sum, int exponent) {
    for (std::size_t k = 0; k < sum.size; ++k) sum.part[k] = std::ldexp(sum.part[k], exponent);
  }

  /// Positive if the vertex where edge `a` ends and `b` begins lies beyond a line, 0 if on it.
  [[nodiscard]] int sideOf(const HalfPlane& a, const HalfPlane& b, const HalfPlane& by) const {
    const double beyond = crossOf(by, b) * a.c + crossOf(a, by) * b.c - crossOf(a, b) * by.c;
    const double sum = crossSize(by, b) * a.size + crossSize(a, by) * b.size + crossSize(a, b) * by.size;
    if (std::abs(beyond) > relative_error * sum && sum > least_sum) return beyond > 0 ? 1 : -1;
    const auto p = exactly(a), q = exactly(b), r = exactly(by);
    return (crossOf(r, q) * p.c + crossOf(p, r) * q.c - crossOf(p, q) * r.c).sign();
  }

  const SiteSet& sites_;
  std::uint32_t cell_ = 0;
  std::vector<HalfPlane> edges_;
  std::vector<int> sides_;  ///< by edge: of its beginning
};

}  // namespace

bool leaveNothing(const SiteSet& sites, std::uint32_t cell, std::span<const std::int32_t> lines) {
  return Remainder(sites).isNothing(cell, lines);
}

void proveEmpty(const SiteSet& sites, std::span<const std::uint32_t> which, int threads,
                NeighborRows& cells) {
  if (sites.weight.empty()) return;
  parallelFor(which.size(), hidden_cells_grain, threads, [&](std::size_t begin, std::size_t end) {
    Remainder remainder(sites);
    for (auto e = begin; e < end; ++e) {
      const auto cell = which[e];
      if (cells.status(cell) != CellStatus::empty) continue;
      const bool proved = remainder.isNothing(cell, cells.edges(cell));
      cells.drop(cell, proved ? CellStatus::empty : CellStatus::open);
    }
  });
}

}  // namespace vorpipe::core
