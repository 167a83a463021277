// Outlines and boxes in degrees, and in the plane.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "base/refusal.h"
#include "base/try.h"
#include "domain/degrees.h"
#include "domain/rings.h"
#include "geometry/polygon_measures.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr double authalic_radius = 6371.0071809185;  ///< km; of the sphere of the area of WGS 84
constexpr double parallel_step = 5;                  ///< degrees, of a box's sides
constexpr double longest_side = 1;                   ///< degrees, of an outline before it is examined

void addRing(std::span<const Point> points, Outline& outline) {
  outline.points.insert(outline.points.end(), points.begin(), points.end());
  outline.ring_offsets.push_back(outline.points.size());
}

/// Adds points from one place on a parallel to another, except the last.
void addParallel(double latitude, double from, double to, std::vector<Point>& ring) {
  const auto steps = static_cast<int>(std::ceil(std::abs(to - from) / parallel_step));
  for (int k = 0; k < steps; ++k) ring.push_back({from + (to - from) * k / steps, latitude});
}

/// Whether a side takes the other way round because that is shorter; a side of a whole turn is intended.
bool crossesAntimeridian(Point a, Point b) {
  const double apart = std::abs(a.x - b.x);
  return apart > whole_turn / 2 && apart < whole_turn;
}

/// Whether a ring ends one turn from its start, as parallels do: then it is closed. At a pole the two ends
/// are one place, to which the ring was led.
bool goesAround(Point last, Point first) {
  return std::abs(first.x - last.x) == whole_turn && first.y == last.y && std::abs(first.y) != quarter_turn;
}

/// Whether the rings are also rings in degrees: none crosses the antimeridian or goes around a pole.
bool hasRingsInDegrees(const Outline& outline) {
  for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
    const auto points = core::ringAt(outline, r);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Point a = points[p], b = core::nextOf(points, p);
      if (crossesAntimeridian(a, b) || (p + 1 == points.size() && goesAround(a, b))) return false;
    }
  }
  return true;
}

/// The sides of a projected ring.
class Sides {
 public:
  Sides(const Projection& projection, double allowed, std::vector<Point>& plane)
      : projection_(projection), allowed_(allowed), plane_(plane) {}

  /// Adds the places from a on, without b. Halving gives the same places from either end, so shared sides
  /// stay shared.
  void add(Point a, Point b) {
    if (crossesAntimeridian(a, b)) b.x += b.x < a.x ? whole_turn : -whole_turn;
    add(a, projection_.toPlane(a), b, projection_.toPlane(b));
  }

 private:
  void add(Point a, Point from, Point b, Point to) {
    const Point middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    const bool halves = middle != a && middle != b;
    const Point at = halves ? projection_.toPlane(middle) : from;
    const double off = std::hypot(at.x - (from.x + to.x) / 2, at.y - (from.y + to.y) / 2);
    const double longer = std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
    if (halves && (longer > longest_side || off > allowed_)) {
      add(a, from, middle, at);
      add(middle, at, b, to);
    } else if (plane_.empty() || plane_.back() != from) {
      plane_.push_back(from);
    }
  }

  const Projection& projection_;
  double allowed_;
  std::vector<Point>& plane_;
};

/// The largest allowed distance of a side from the chord between two added points.
double allowedDeviation(const Projection& projection, const Outline& degrees) {
  constexpr double part = 1e-6;
  std::vector<Point> plane;
  plane.reserve(degrees.points.size());
  for (const Point place : degrees.points) plane.push_back(projection.toPlane(place));
  const Box box = boxOf(plane);
  return part * std::max(box.xmax - box.xmin, box.ymax - box.ymin);
}

Result<double> reachOf(std::span<const Point> kilometers) {
  double farthest = 0;
  for (const Point point : kilometers) farthest = std::max(farthest, std::hypot(point.x, point.y));
  const double half = std::min(farthest / (2 * authalic_radius), 1.0);
  const double reach = 2 * std::asin(half) / degree;
  if (reach <= quarter_turn) return reach;
  return tl::unexpected(
      refusal(Subject::domain, fmt::format("the domain may reach {} degrees from the center of the "
                                           "projection, and reaches {:.0f}",
                                           quarter_turn, reach)));
}

}  // namespace

Result<Outline> outlineOfDegrees(const Box& degrees) {
  const auto refuse = [](std::string_view what) {
    return tl::unexpected(refusalOf(Subject::domain, std::string(what)));
  };
  const auto [xmin, ymin, xmax, ymax] = degrees;
  if (!(xmin >= -whole_turn) || !(xmax <= whole_turn))
    return refuse("its longitudes are not within 360 degrees of 0");
  if (!(ymin >= -quarter_turn) || !(ymax <= quarter_turn))
    return refuse("its latitudes are not within 90 degrees of 0");
  if (xmin > xmax && xmin - xmax < whole_turn) {
    return refuse(fmt::format("it is no box: across the antimeridian its xmax is {}", xmax + whole_turn));
  }
  if (!(xmin < xmax) || !(ymin < ymax)) return refuse("it is no box");
  if (xmax - xmin > whole_turn) return refuse("it is more than 360 degrees wide");
  Outline outline;
  outline.ring_offsets = outline.polygon_offsets = {0};
  std::vector<Point> ring;
  if (xmax - xmin < whole_turn) {
    addParallel(ymin, xmin, xmax, ring);
    ring.push_back({xmax, ymin});
    addParallel(ymax, xmax, xmin, ring);
    ring.push_back({xmin, ymax});
    addRing(ring, outline);
  } else {
    // Around a pole: the parallel away from it, and inside it the other parallel, unless that is the pole
    // itself.
    if (ymin == -quarter_turn && ymax == quarter_turn) return refuse("it is the whole Earth");
    if (ymin < 0 && ymax > 0) {
      return refuse(
          "it goes around the Earth on both sides of the equator, farther than 90 degrees from either pole; "
          "name a part of it");
    }
    const bool north = ymin + ymax > 0;
    for (const double latitude : {north ? ymin : ymax, north ? ymax : ymin}) {
      if (std::abs(latitude) == quarter_turn) continue;
      ring.clear();
      // Of the two sides of the equator, the intended one lies to the left.
      addParallel(latitude, north ? xmin : xmax, north ? xmax : xmin, ring);
      ring.push_back({north ? xmax : xmin, latitude});
      addRing(ring, outline);
    }
  }
  outline.polygon_offsets.push_back(outline.ring_offsets.size() - 1);
  return outline;
}

Result<Outline> toPlane(const Projection& projection, const Outline& degrees) {
  VORPIPE_TRY(projectionAmid(degrees));
  const double allowed = allowedDeviation(projection, degrees);
  Outline outline;
  outline.ring_offsets = {0};
  outline.polygon_offsets = degrees.polygon_offsets;
  for (std::size_t r = 0; r + 1 < degrees.ring_offsets.size(); ++r) {
    const auto places = core::ringAt(degrees, r);
    std::vector<Point> ring;
    Sides sides(projection, allowed, ring);
    for (std::size_t p = 0; p < places.size(); ++p) {
      const Point next = core::nextOf(places, p);
      if (p + 1 == places.size() && goesAround(places[p], next)) break;
      sides.add(places[p], next);
    }
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    addRing(ring, outline);
  }
  return outline;
}

Result<MendedOutline> mendedToPlane(const Projection& projection, const Outline& degrees, bool repair) {
  // Parts fit each other best in degrees; but a side that goes the other way round would cross others there.
  const bool is_outline = hasRingsInDegrees(degrees);
  auto first = is_outline ? mended(degrees, repair) : Result<MendedOutline>(MendedOutline{degrees, {}});
  if (!first) return first;
  VORPIPE_LET(plane, toPlane(projection, first->outline));
  // Messages give places in degrees, as the outline was given, to 9 decimals: more are rounding of the
  // projection.
  constexpr double decimals = 1e9;
  const OutlineWords words{
      [&](Point kilometers) {
        const Point at = projection.toDegrees(kilometers);
        return Point{std::round(at.x * decimals) / decimals, std::round(at.y * decimals) / decimals};
      },
      " km2"};
  auto second = mended(plane, repair || is_outline, words);
  if (!second) return second;
  // A valid outline in degrees may touch itself in the plane, as along the antimeridian: that is no repair.
  if (!repair) second->changes.clear();
  if (!first->changes.empty() && !second->changes.empty()) first->changes += "; ";
  second->changes = first->changes + second->changes;
  return second;
}

Result<double> reachOf(const Outline& kilometers) { return reachOf(std::span(kilometers.points)); }

Result<double> reachOf(const Box& kilometers) {
  const auto [xmin, ymin, xmax, ymax] = kilometers;
  const std::array<Point, 4> corners = {{{xmin, ymin}, {xmax, ymin}, {xmax, ymax}, {xmin, ymax}}};
  return reachOf(std::span(corners));
}

double distortionAt(double degrees_from_center) { return 1 / std::cos(degrees_from_center / 2 * degree) - 1; }

}  // namespace vorpipe
