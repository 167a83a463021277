#include "motion/allowed_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "domain/edge_tree.h"
#include "motion/movable.h"

namespace vorpipe::moving {
namespace {

/// Returns the place of the edge from a to b that is nearest to p.
Point nearestOnEdge(Point a, Point b, Point p) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double along = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return {a.x + along * dx, a.y + along * dy};
}

}  // namespace

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
        const Point at = nearestOnEdge(rings.points[edge], rings.points[rings.next(edge)], p);
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
    : domain_(domain), x_repeats_(repeats(periodic).x), y_repeats_(repeats(periodic).y) {
  if (outline.empty()) return;
  // Not scaled: exact predicates support the range of coordinates.
  if (auto rings = core::ringsOf(outline, 0)) shape_ = std::make_unique<Shape>(std::move(*rings));
}

AllowedPlaces::AllowedPlaces(AllowedPlaces&&) noexcept = default;
AllowedPlaces& AllowedPlaces::operator=(AllowedPlaces&&) noexcept = default;
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
