#include "motion/movable.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "base/inside.h"
#include "base/refusal.h"
#include "base/try.h"
#include "domain/edge_tree.h"

namespace vorpipe::moving {
namespace {

struct Range {
  double least, most;
  [[nodiscard]] bool contains(double value) const { return value >= least && value <= most; }
};

constexpr Range sides{1e-40, 1e40}, densities{1e-30, 1e30};

}  // namespace

Result<void> checkMovable(const Sites& sites, const CellsOptions& options, int threads) {
  VORPIPE_TRY(checkInput(sites, options, threads));
  const double width = options.domain.xmax - options.domain.xmin;
  const double height = options.domain.ymax - options.domain.ymin;
  if (!sides.contains(width) || !sides.contains(height)) {
    return tl::unexpected(refusal(
        Subject::domain, fmt::format("the domain is {} wide and {} high: what moves sites takes sides of "
                                     "{:.0e} to {:.0e}; scale the sites",
                                     width, height, sides.least, sides.most)));
  }
  return options.density.values.empty() ? Result<void>{} : checkRange(options.density);
}

Result<void> checkRange(const Density& density) {
  const double largest = *std::ranges::max_element(density.values);
  if (densities.contains(largest)) return {};
  return tl::unexpected(refusalOf(
      Subject::density, fmt::format("its largest value is {}: what moves sites takes {:.0e} to {:.0e}",
                                    largest, densities.least, densities.most)));
}

RepeatingAxes repeats(Periodic periodic) {
  return {periodic == Periodic::x || periodic == Periodic::xy,
          periodic == Periodic::y || periodic == Periodic::xy};
}

Result<void> checkPlaces(const Sites& sites, const Box& domain, Periodic periodic) {
  std::vector<std::uint32_t> order(sites.size());
  std::iota(order.begin(), order.end(), 0u);
  const RepeatingAxes along = repeats(periodic);
  const auto placeOf = [&](std::uint32_t i) {
    return std::pair(along.x && sites.x[i] == domain.xmax ? domain.xmin : sites.x[i],
                     along.y && sites.y[i] == domain.ymax ? domain.ymin : sites.y[i]);
  };
  std::ranges::sort(order,
                    [&](auto a, auto b) { return std::pair(placeOf(a), a) < std::pair(placeOf(b), b); });
  const auto same =
      std::ranges::adjacent_find(order, [&](auto a, auto b) { return placeOf(a) == placeOf(b); });
  if (same == order.end()) return {};
  return tl::unexpected(refusal(
      Subject::sites,
      fmt::format("sites {} and {} (counted from 0) are at one place, so that neither can have its mass",
                  *same, *std::next(same))));
}

Result<void> checkTolerance(double tolerance) {
  if (tolerance >= 0 && std::isfinite(tolerance)) return {};
  return tl::unexpected(
      Error{ErrorCode::input, fmt::format("tolerance: {} is not a finite number of 0 or more", tolerance)});
}

struct AllowedPlaces::Shape {
  explicit Shape(core::Rings from) : rings(std::move(from)), index(rings) {}

  /// Searches in growing boxes until one holds an edge nearer than any edge outside of it can be.
  [[nodiscard]] Point nearestOnRings(Point p, double reach) const {
    std::vector<std::uint32_t> near;
    for (double half = reach * 0x1p-10;; half *= 2) {
      index.edgesIn({p.x - half, p.y - half, p.x + half, p.y + half}, near);
      Point best = p;
      double least = std::numeric_limits<double>::infinity();
      for (const std::uint32_t edge : near) {
        const Point at = nearestOnLine(rings.points[edge], rings.points[rings.next(edge)], p);
        const double distance = std::hypot(at.x - p.x, at.y - p.y);
        if (distance < least) best = at;
        least = std::min(least, distance);
      }
      if (least <= half) return best;
    }
  }

  core::Rings rings;
  core::OutlineIndex index;
};

AllowedPlaces::AllowedPlaces(const Box& domain, const Outline& outline, Periodic periodic)
    : domain_(domain), repeats_(repeats(periodic)) {
  if (outline.empty()) return;
  // Not scaled: exact predicates support the range of coordinates.
  if (auto rings = core::ringsOf(outline, 0)) shape_ = std::make_unique<Shape>(std::move(*rings));
}

AllowedPlaces::~AllowedPlaces() = default;

bool AllowedPlaces::contain(Point place) const {
  return inBox(place) == place && (!shape_ || shape_->index.contains(place));
}

Point AllowedPlaces::nearestInShape(Point place) const {
  const Point boxed = inBox(place);
  if (shape_->index.contains(boxed)) return boxed;
  const double size = std::max(domain_.xmax - domain_.xmin, domain_.ymax - domain_.ymin);
  const Point wall = shape_->nearestOnRings(place, size);
  // A little further in, so that rounding does not leave the site outside.
  const double way = std::hypot(wall.x - place.x, wall.y - place.y);
  if (!(way > 0)) return wall;
  const double part = 1e-9 * size / way;
  const Point inside{wall.x + part * (wall.x - place.x), wall.y + part * (wall.y - place.y)};
  return shape_->index.contains(inside) ? inside : wall;
}

}  // namespace vorpipe::moving
