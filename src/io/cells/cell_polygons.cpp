#include "io/cells/cell_polygons.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "io/meshes/cell_rings.h"

namespace vorpipe {
namespace {

constexpr double half_turn = 180, whole_turn = 360, pole = 90;  // degrees

bool jumps(const Point& a, const Point& b) { return std::abs(b.x - a.x) > half_turn; }

/// Edges that are straight in the plane bend in degrees, near a pole so much that cells would not hold their
/// sites: such edges get places in between.
class BentRing {
 public:
  BentRing(const Projection& projection, std::span<const Point> ring) : projection_(projection) {
    bool round = false, bends = false;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point &a = ring[k], &b = ring[k + 1 < ring.size() ? k + 1 : 0];
      round = round || jumps(a, b);
      bends = bends || std::abs(std::remainder(b.x - a.x, whole_turn)) > least_way;
    }
    if (!bends) return;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point &a = ring[k], &b = ring[k + 1 < ring.size() ? k + 1 : 0];
      add(a, round);
      const Point from = projection.toPlane(a), to = projection.toPlane(b);
      addBetween(a, from, b, to, lengthOf(from, to) * shortest, round);
    }
  }

  /// Nothing: no edge bends.
  [[nodiscard]] std::vector<Point>& points() { return points_; }

 private:
  static constexpr double least_way = 10;      ///< degrees of longitude; what has less bends little
  static constexpr double most_off = 0.02;     ///< of an edge's length, that its middle may be off
  static constexpr double shortest = 0x1p-16;  ///< of an edge: one through the pole always bends

  static double lengthOf(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }

  /// In the turn of the point before; a ring around a pole stays as it is.
  void add(Point point, bool round) {
    if (!round && !points_.empty())
      point.x += whole_turn * std::round((points_.back().x - point.x) / whole_turn);
    points_.push_back(point);
  }

  /// Halving gives the same places from either end, so that neighbors still share them.
  void addBetween(Point a, Point from, Point b, Point to, double least, bool round) {
    const double way = std::remainder(b.x - a.x, whole_turn), length = lengthOf(from, to);
    if (std::abs(way) <= least_way || length <= least) return;
    const Point middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
    const Point chord = projection_.toPlane({a.x + way / 2, (a.y + b.y) / 2});
    if (lengthOf(chord, middle) <= most_off * length) return;
    const Point at = projection_.toDegrees(middle);
    addBetween(a, from, at, middle, least, round);
    add(at, round);
    addBetween(at, middle, b, to, least, round);
  }

  const Projection& projection_;
  std::vector<Point> points_;
};

/// A ring around a pole from the meridian of its cut once around to it. East: its inside lies to the north.
struct Round {
  std::vector<Point> points;  ///< the first and the last lie on the meridian
  bool east;
};

/// The latitude at which an edge that jumps crosses the meridian, half a turn from `middle`.
double latitudeAtCut(const Point& a, const Point& b, double middle) {
  const double from_a = half_turn - std::abs(a.x - middle), from_b = half_turn - std::abs(b.x - middle);
  const double way = from_a + from_b;
  return way > 0 ? a.y + (b.y - a.y) * (from_a / way) : a.y;
}

/// The ring, if it goes around a pole. Where it crosses the meridian several times, it is cut where it is
/// nearest to the pole that lies on its inside: from there nothing is in the way.
std::optional<Round> roundOf(std::span<const Point> ring, double middle) {
  std::size_t count = 0, cut = 0;
  double turns = 0, highest = 0;
  const auto next = [&](std::size_t k) { return k + 1 < ring.size() ? k + 1 : 0; };
  for (std::size_t k = 0; k < ring.size(); ++k) {
    if (jumps(ring[k], ring[next(k)])) turns += ring[k].x > ring[next(k)].x ? 1 : -1;
  }
  const bool east = turns > 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    if (!jumps(ring[k], ring[next(k)])) continue;
    const double latitude = latitudeAtCut(ring[k], ring[next(k)], middle) * (east ? 1 : -1);
    if (count++ > 0 && latitude <= highest) continue;
    highest = latitude;
    cut = k;
  }
  if (count % 2 == 0) return {};
  const double latitude = latitudeAtCut(ring[cut], ring[next(cut)], middle);
  const double from = middle + (east ? -half_turn : half_turn);
  Round round{{}, east};
  const auto add = [&](Point point) {
    if (round.points.empty() || round.points.back() != point) round.points.push_back(point);
  };
  add({from, latitude});
  double longitude = from;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    Point point = ring[(cut + 1 + k) % ring.size()];
    longitude = point.x += whole_turn * std::round((longitude - point.x) / whole_turn);
    add(point);
  }
  add({middle + (east ? half_turn : -half_turn), latitude});
  return round;
}

}  // namespace

CellPolygons::CellPolygons(const Diagram& diagram, std::size_t site, const CoordinateSystem& system) {
  std::optional<Round> open;
  const auto close = [&](const std::vector<Point>& back) {
    std::vector<Point> ring = std::move(open->points);
    ring.insert(ring.end(), back.begin(), back.end());
    polygons_.push_back({made_.emplace_back(std::move(ring))});
    open.reset();
  };
  const auto closeAtPole = [&] {
    const double latitude = open->east ? pole : -pole;
    close({{open->points.back().x, latitude}, {open->points.front().x, latitude}});
  };
  const auto& center = system.from_plane_around;
  std::optional<Projection> projection;
  if (center) projection = Projection::around(*center).value();
  for (const Ring& ring : ringsOf(diagram, site)) {
    auto vertices = verticesOf(diagram, ring);
    if (projection) {
      BentRing bent(*projection, vertices);
      if (!bent.points().empty()) vertices = made_.emplace_back(std::move(bent.points()));
    }
    auto round = center ? roundOf(vertices, center->x) : std::nullopt;
    if (!round) {
      if (ring.hole && !polygons_.empty()) {
        polygons_.back().push_back(vertices);
      } else {
        polygons_.push_back({vertices});
      }
    } else if (open && open->east != round->east) {
      close(round->points);
    } else {
      if (open) closeAtPole();
      open = std::move(round);
    }
  }
  if (open) closeAtPole();
}

}  // namespace vorpipe
