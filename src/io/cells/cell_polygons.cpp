#include "io/cells/cell_polygons.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vorpipe {
namespace {

constexpr double half_turn = 180, whole_turn = 360, pole = 90;  // degrees

/// A ring whose longitudes continue from point to point, beyond half a turn if necessary. Edges that are
/// straight in the plane bend in degrees. Near a pole they bend so much that cells would not contain their
/// sites: such edges get points in between. A pole on the ring becomes two points, at the longitudes where
/// the ring arrives and leaves.
class UnrolledRing {
 public:
  UnrolledRing(const Projection& projection, std::span<const Point> ring) : projection_(projection) {
    if (!needsPoints(ring)) return;
    for (const double latitude : {pole, -pole}) {
      const Point at = projection.toPlane({projection.center().x, latitude});
      if (std::isfinite(at.x) && std::isfinite(at.y)) poles_.push_back({latitude, at});
    }
    std::size_t first = 0;
    while (first < ring.size() && poleAt(projection.toPlane(ring[first])) != nullptr) ++first;
    if (first == ring.size()) return;
    points_.push_back(ring[first]);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      addEdge(ring[(first + k) % ring.size()], ring[(first + k + 1) % ring.size()]);
    }
    turns_ = static_cast<int>(std::round((points_.back().x - points_.front().x) / whole_turn));
    points_.pop_back();
  }

  /// Empty if no edge bends or leads into another turn: the ring is unchanged. The first point is not
  /// repeated at the end.
  [[nodiscard]] std::vector<Point>& points() { return points_; }
  /// Around a pole: 1 if the inside lies to the north, -1 if to the south; else 0.
  [[nodiscard]] int turns() const { return turns_; }

 private:
  struct Pole {
    double latitude;
    Point plane;
  };

  static constexpr double least_way = 10;   ///< degrees of longitude; shorter edges bend little
  static constexpr double most_off = 0.02;  ///< fraction of an edge's length by which its middle may be off
  static constexpr double shortest = 0x1p-16;  ///< length of an edge: one beside the pole always bends
  static constexpr double at_pole = 1e-6;      ///< km; nearer to a pole, longitudes are rounding errors

  static double lengthOf(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }

  static bool needsPoints(std::span<const Point> ring) {
    constexpr double near = 89.99;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point &a = ring[k], &b = ring[k + 1 < ring.size() ? k + 1 : 0];
      const double way = b.x - a.x;
      const bool jumps = std::abs(way) > half_turn,
                 bends = std::abs(std::remainder(way, whole_turn)) > least_way;
      if (jumps || bends || std::abs(a.y) > near) return true;
    }
    return false;
  }

  [[nodiscard]] const Pole* poleAt(Point plane) const {
    const auto found = std::ranges::find_if(
        poles_, [&](const Pole& each) { return lengthOf(each.plane, plane) <= at_pole; });
    return found == poles_.end() ? nullptr : &*found;
  }

  /// Returns the pole that an edge passes through.
  [[nodiscard]] const Pole* poleBetween(Point from, Point to) const {
    const double length = lengthOf(from, to);
    const auto found = std::ranges::find_if(poles_, [&](const Pole& each) {
      const Point way{each.plane.x - from.x, each.plane.y - from.y};
      const double along = (way.x * (to.x - from.x) + way.y * (to.y - from.y)) / length;
      const double off = (way.x * (to.y - from.y) - way.y * (to.x - from.x)) / length;
      return along > 0 && along < length && std::abs(off) <= at_pole;
    });
    return found == poles_.end() ? nullptr : &*found;
  }

  void addEdge(Point a, Point b) {
    const Point from = projection_.toPlane(a), to = projection_.toPlane(b);
    if (const Pole* end = poleAt(to)) {
      points_.push_back({points_.back().x, end->latitude});
    } else if (const Pole* begin = poleAt(from)) {
      continueFrom(*begin, b);
    } else if (const Pole* between = poleBetween(from, to)) {
      points_.push_back({points_.back().x, between->latitude});
      continueFrom(*between, b);
    } else {
      addBetween(a, from, b, to, lengthOf(from, to) * shortest);
      add(b);
    }
  }

  /// Continues from a pole to a point. The inside lies to the left: west of a ring that reaches the north
  /// pole, and east of one that reaches the south pole.
  void continueFrom(const Pole& from, Point to) {
    const double arrival = points_.back().x;
    const double east = to.x - arrival - whole_turn * std::floor((to.x - arrival) / whole_turn);
    to.x = arrival + (from.latitude > 0 ? east - whole_turn : east);
    points_.push_back({to.x, from.latitude});
    points_.push_back(to);
  }

  void add(Point point) {
    point.x += whole_turn * std::round((points_.back().x - point.x) / whole_turn);
    points_.push_back(point);
  }

  /// Halving gives the same points from either end, so that neighbors still share them.
  void addBetween(Point a, Point from, Point b, Point to, double least) {
    const double way = std::remainder(b.x - a.x, whole_turn), length = lengthOf(from, to);
    if (std::abs(way) <= least_way || length <= least) return;
    const Point middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
    const Point chord = projection_.toPlane({a.x + way / 2, (a.y + b.y) / 2});
    if (lengthOf(chord, middle) <= most_off * length) return;
    const Point at = projection_.toDegrees(middle);
    addBetween(a, from, at, middle, least);
    add(at);
    addBetween(at, middle, b, to, least);
  }

  const Projection& projection_;
  std::vector<Pole> poles_;
  std::vector<Point> points_;
  int turns_ = 0;
};

/// A ring around a pole, from the meridian of its cut once around back to it. East: its inside lies to the
/// north.
struct Round {
  std::vector<Point> points;  ///< the first and the last lie on the meridian
  bool east;
};

/// A ring around a pole, cut at the meridian half a turn from `middle`. If it crosses that several times, the
/// cut is where it is nearest to the pole on its inside: nothing lies between them.
Round roundOf(const std::vector<Point>& ring, int turns, double middle) {
  const bool east = turns > 0;
  const auto at = [&](std::size_t k) {
    return k < ring.size() ? ring[k]
                           : Point{ring[k - ring.size()].x + whole_turn * turns, ring[k - ring.size()].y};
  };
  const double meridian = middle + half_turn;
  const auto turnOf = [&](double longitude) { return std::floor((longitude - meridian) / whole_turn); };
  std::size_t cut = 0;
  Point crossing{};
  bool any = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = at(k), b = at(k + 1);
    if (turnOf(a.x) == turnOf(b.x)) continue;
    const double x = meridian + whole_turn * std::max(turnOf(a.x), turnOf(b.x));
    const Point here{x, a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x))};
    if (any && (east ? here.y <= crossing.y : here.y >= crossing.y)) continue;
    any = true;
    crossing = here;
    cut = k;
  }
  const double from = middle + (east ? -half_turn : half_turn), moved = from - crossing.x;
  Round round{{{from, crossing.y}}, east};
  const auto add = [&](Point point) {
    if (round.points.back() != point) round.points.push_back(point);
  };
  for (std::size_t k = cut + 1; k <= cut + ring.size(); ++k) add({at(k).x + moved, at(k).y});
  add({from + whole_turn * turns, crossing.y});
  return round;
}

}  // namespace

std::vector<Ring> ringsOf(const Diagram& diagram, std::size_t site) {
  constexpr std::uint64_t least_vertices = 3;
  const CellRings all = diagram.cell(site).rings();
  std::vector<Ring> rings;
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (all[r].size() >= least_vertices) rings.push_back({all.begin(r), all.end(r), all.isHole(r)});
  }
  return rings;
}

bool hasPolygon(const Diagram& diagram, std::size_t site) {
  // On the globe a cell of two vertices has one, and so has the only cell.
  if (!diagram.solid_angle.empty() && diagram.ring_starts.empty()) return diagram.status[site] == Status::ok;
  return !ringsOf(diagram, site).empty();
}

void CellPolygons::addOnGlobe(const Outline& outline) {
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    Rings& rings = polygons_.emplace_back();
    for (auto r = outline.polygon_offsets[p]; r < outline.polygon_offsets[p + 1]; ++r) {
      const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
      const auto ring = std::span(outline.points).subspan(begin, end - begin);
      rings.push_back(new_rings_.emplace_back(ring.begin(), ring.end()));
    }
  }
}

CellPolygons::CellPolygons(const Sites& sites, const Diagram& diagram, std::size_t site,
                           const CoordinateSystem& system) {
  if (system.on_globe) {
    addOnGlobe(globePolygons(sites, diagram, site));
    return;
  }
  std::optional<Round> open;
  const auto close = [&](const std::vector<Point>& back) {
    std::vector<Point> ring = std::move(open->points);
    ring.insert(ring.end(), back.begin(), back.end());
    polygons_.push_back({new_rings_.emplace_back(std::move(ring))});
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
    std::optional<Round> round;
    if (projection) {
      UnrolledRing unrolled(*projection, vertices);
      if (unrolled.turns() != 0) round = roundOf(unrolled.points(), unrolled.turns(), center->x);
      if (!unrolled.points().empty()) vertices = new_rings_.emplace_back(std::move(unrolled.points()));
    }
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
