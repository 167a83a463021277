#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "domain/degrees.h"
#include "domain/geos_outline.h"
#include "domain/rings.h"
#include "globe/sphere_map.h"
#include "vorpipe/cell.h"
#include "vorpipe/globe.h"

namespace vorpipe {
namespace {

using namespace core;

constexpr double half_turn = whole_turn / 2;
constexpr double some_part = 0.375;  // of an edge

/// Calls add(direction) for the ends of an arc's pieces, each of `longest` degrees or less. Both cells of an
/// edge get the same points.
template <class Add>
void forEachPiece(const GreatArc& arc, double longest, const Add& add) {
  const auto pieces = std::max(1, static_cast<int>(std::ceil(arc.angle / (longest * degree))));
  for (int k = 1; k < pieces; ++k) add(pieceEnd(arc, k, pieces));
  add(arc.end);
}

/// The shorter way between two directions.
GreatArc shorterArc(const Direction& begin, const Direction& end) {
  return {begin, end, normalized(cross(begin, end)), angleBetween(begin, end)};
}

/// A ring, or a line, of longitudes and latitudes. Longitudes continue from point to point, beyond half a
/// turn if necessary.
class UnrolledBorder {
 public:
  /// Adds the arc's points after its first.
  void add(const GreatArc& arc) {
    if (points_.empty()) points_.push_back(placeOf(arc.begin));
    Direction last = arc.begin;
    forEachPiece(arc, longest, [&](const Direction& at) {
      addPiece(last, at, arc.axis.z);
      last = at;
    });
  }

  /// The line as it is. One from a pole begins with the longitude where it leads.
  [[nodiscard]] std::vector<Point> line() && {
    if (points_.size() > 1 && std::abs(points_.front().y) == quarter_turn && points_[1].y == points_[0].y) {
      points_.erase(points_.begin());
      const double turn = whole_turn * std::round(points_.front().x / whole_turn);
      for (Point& p : points_) p.x -= turn;
    }
    return std::move(points_);
  }

  /// Its points, in the turn where it begins. A ring around a pole is led to that pole along longitude 180.
  [[nodiscard]] std::vector<Point> ring() const {
    std::vector<Point> points(points_.begin(), points_.end() - 1);
    const double turns = std::round((points_.back().x - points_.front().x) / whole_turn);
    if (turns == 0) return points;
    // It crosses that longitude, between `before` and the next point.
    const auto turnOf = [](const Point& p) { return std::floor((p.x + half_turn) / whole_turn); };
    std::size_t before = 0;
    while (turnOf(points_[before]) == turnOf(points_[before + 1])) ++before;
    const Point a = points_[before], b = points_[before + 1];
    const double side = std::copysign(half_turn, turns);
    const double seam = whole_turn * std::max(turnOf(a), turnOf(b)) - half_turn;
    const double latitude = a.y + (b.y - a.y) * ((seam - a.x) / (b.x - a.x));
    const double pole = std::copysign(quarter_turn, turns);
    std::vector<Point> led{{-side, latitude}};
    for (std::size_t k = 1; k <= points.size(); ++k) {
      const auto at = before + k;
      const Point p = points[at < points.size() ? at : at - points.size()];
      const double turned = at < points.size() ? 0 : whole_turn * turns;
      led.push_back({p.x + turned - seam - side, p.y});
    }
    for (const Point p : {Point{side, latitude}, Point{side, pole}, Point{-side, pole}}) led.push_back(p);
    led.erase(std::unique(led.begin(), led.end()), led.end());
    return led;
  }

 private:
  static constexpr double longest = 0.25;   ///< degrees between points
  static constexpr double most_off = 1e-5;  ///< of the Earth's radius
  /// How far a straight line of degrees may be off, of its length: near poles lines would cross else.
  static constexpr double most_bent = 0.01, shortest = 1e-9;
  static constexpr double at_pole = 1e-12;

  static bool isPole(const Direction& a) { return std::hypot(a.x, a.y) <= at_pole; }

  /// Adds the places after `a` up to `b`, which is near, along an arc that runs east if `east` is positive.
  void addPiece(const Direction& a, const Direction& b, double east) {
    const Direction middle = normalized(a + b);
    const Point from = placeOf(a), to = placeOf(b);
    const bool at_a_pole = isPole(a) || isPole(b);
    const double way = std::remainder(to.x - from.x, whole_turn);
    const Point chord{from.x + way / 2, (from.y + to.y) / 2}, at = placeOf(middle);
    const double off = std::hypot(std::remainder(at.x - chord.x, whole_turn), at.y - chord.y);
    const bool bends =
        off > most_bent * std::hypot(way, to.y - from.y) || lengthOf(directionOf(chord) - middle) > most_off;
    if (!at_a_pole && bends && lengthOf(b - a) > shortest) {
      addPiece(a, middle, east);
      addPiece(middle, b, east);
    } else {
      addPlace(a, b, east);
    }
  }

  void addPlace(const Direction& from, const Direction& at, double east) {
    const Point last = points_.back();
    Point place = placeOf(at);
    if (isPole(at)) {
      points_.push_back({last.x, std::copysign(quarter_turn, at.z)});
      return;
    }
    double way = std::remainder(place.x - last.x, whole_turn);
    if (std::abs(last.y) == quarter_turn) {
      // The inside lies to the left: west of a ring that reaches the north pole, east of one at the south
      // pole.
      if (last.y > 0 && way > 0) way -= whole_turn;
      if (last.y < 0 && way < 0) way += whole_turn;
      points_.push_back({last.x + way, last.y});
    } else if (std::abs(way) > quarter_turn && way * east < 0) {
      way += std::copysign(whole_turn, east);
    }
    addSeam(from, at, last.x + way);
    points_.push_back({last.x + way, place.y});
  }

  /// Adds the place where the great circle through two places crosses longitude 180, if the line from the
  /// last point to one of this longitude does.
  void addSeam(const Direction& from, const Direction& to, double longitude) {
    const auto [west, east] = std::minmax(points_.back().x, longitude);
    const double seam = half_turn + whole_turn * std::floor((east - half_turn) / whole_turn);
    if (!(seam > west && seam < east)) return;
    const Direction axis = cross(from, to);
    points_.push_back({seam, std::atan(axis.x / axis.z) / degree});
  }

  std::vector<Point> points_;
};

/// A ring of a cell, from vertex to vertex along great circles.
template <class ArcAt>
std::vector<Point> unrolled(const std::vector<Direction>& vertices, const ArcAt& arcAt) {
  // A ring begins elsewhere than at a pole, where it would have no longitude.
  const auto isAtPole = [&](std::size_t k) { return std::abs(placeOf(vertices[k]).y) == quarter_turn; };
  std::size_t first = 0;
  while (first + 1 < vertices.size() && isAtPole(first)) ++first;
  UnrolledBorder border;
  const GreatArc start = arcAt(first);
  const Direction between = pointOn(start, some_part);
  border.add(isAtPole(first) ? GreatArc{between, start.end, start.axis, (1 - some_part) * start.angle}
                             : start);
  for (std::size_t k = 1; k < vertices.size(); ++k) border.add(arcAt((first + k) % vertices.size()));
  if (isAtPole(first)) border.add({start.begin, between, start.axis, some_part * start.angle});
  return border.ring();
}

/// The turns that a ring reaches into, as multiples of a whole turn.
struct Turns {
  double first, last;
};

Turns turnsOf(std::span<const Point> ring) {
  const auto [west, east] = std::ranges::minmax(ring, {}, &Point::x);
  const double first = std::floor((west.x + half_turn) / whole_turn);
  return {first, std::max(first, std::ceil((east.x + half_turn) / whole_turn) - 1)};
}

void addRing(std::span<const Point> ring, bool is_hole, Outline& outline) {
  if (outline.ring_offsets.empty()) outline.ring_offsets = outline.polygon_offsets = {0};
  outline.points.insert(outline.points.end(), ring.begin(), ring.end());
  outline.ring_offsets.push_back(outline.points.size());
  if (!is_hole) outline.polygon_offsets.push_back(0);
  outline.polygon_offsets.back() = outline.ring_offsets.size() - 1;
}

/// The part of a whole cell's ring within half a turn of a longitude, which becomes 0. It is one, since a
/// meridian crosses a convex cell once.
std::vector<Point> within(std::vector<Point> ring, double longitude) {
  for (const double side : {1.0, -1.0}) {
    std::vector<Point> kept;
    const auto over = [&](Point p) { return side * (p.x - longitude) - half_turn; };
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k], b = ring[k + 1 < ring.size() ? k + 1 : 0];
      const double of_a = over(a), of_b = over(b);
      if (of_a <= 0) kept.push_back(a);
      if ((of_a < 0 && of_b > 0) || (of_a > 0 && of_b < 0)) {
        kept.push_back({longitude + side * half_turn, a.y + (b.y - a.y) * (of_a / (of_a - of_b))});
      }
    }
    ring = std::move(kept);
  }
  for (Point& p : ring) p.x -= longitude;
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  const bool has_width =
      !ring.empty() && std::ranges::any_of(ring, [&](Point p) { return p.x != ring[0].x; });
  return has_width ? ring : std::vector<Point>{};
}

/// Whether a ring was led to a pole.
bool isAround(std::span<const Point> ring) {
  return std::abs(ring.back().x - ring[ring.size() - 2].x) > half_turn;
}

/// A cell's polygon with holes, cut at longitude 180. The first ring is the outer one.
void addCut(std::vector<std::vector<Point>> rings, Outline& outline) {
  const Turns turns = turnsOf(rings.front());
  const auto [west, east] = std::ranges::minmax(rings.front(), {}, &Point::x);
  const double middle = west.x + (east.x - west.x) / 2;
  for (std::size_t r = 1; r < rings.size(); ++r) {
    const auto [from, to] = std::ranges::minmax(rings[r], {}, &Point::x);
    const double turn = whole_turn * std::round((middle - from.x - (to.x - from.x) / 2) / whole_turn);
    for (Point& p : rings[r]) p.x += turn;
  }
  if (turns.first == 0 && turns.last == 0) {
    for (std::size_t r = 0; r < rings.size(); ++r) addRing(rings[r], r > 0, outline);
    return;
  }
  const Geos geos;
  const auto polygonOfRing = [&](const std::vector<Point>& ring) {
    Outline alone;
    addRing(ring, false, alone);
    return owned(geos, GEOSMakeValid_r(geos.handle(), polygonOf(geos, alone, 0).get()));
  };
  GeosGeometry whole = polygonOfRing(rings.front());
  for (std::size_t r = 1; r < rings.size() && whole; ++r) {
    const GeosGeometry ring = polygonOfRing(rings[r]);
    // What lies to the left of a ring around a pole is what is not in the hole.
    whole = owned(geos, isAround(rings[r]) ? GEOSIntersection_r(geos.handle(), whole.get(), ring.get())
                                           : GEOSDifference_r(geos.handle(), whole.get(), ring.get()));
  }
  for (double turn = turns.first; turn <= turns.last && whole; ++turn) {
    const double longitude = turn * whole_turn;
    const GeosGeometry box = polygonOfRing({{longitude - half_turn, -quarter_turn},
                                            {longitude + half_turn, -quarter_turn},
                                            {longitude + half_turn, quarter_turn},
                                            {longitude - half_turn, quarter_turn}});
    const auto part = owned(geos, GEOSIntersection_r(geos.handle(), whole.get(), box.get()));
    Outline of_turn;
    addPolygons(geos, part.get(), of_turn);
    for (Point& p : of_turn.points) p.x -= longitude;
    for (std::size_t p = 0; p + 1 < of_turn.polygon_offsets.size(); ++p) {
      const auto first = of_turn.polygon_offsets[p];
      for (auto r = first; r < of_turn.polygon_offsets[p + 1]; ++r) {
        const auto ring = ringAt(of_turn, r);
        std::vector<Point> turned(ring.begin(), ring.end());
        if ((areaOfRing(ring) > 0) != (r == first)) std::ranges::reverse(turned);
        addRing(turned, r > first, outline);
      }
    }
  }
}

/// The polygons of a cell of the whole sphere.
Outline wholePolygons(const Sites& sites, const Diagram& diagram, const Cell& cell) {
  Outline outline;
  if (cell.rings().empty()) {
    addRing(std::array{Point{-half_turn, -quarter_turn}, Point{half_turn, -quarter_turn},
                       Point{half_turn, quarter_turn}, Point{-half_turn, quarter_turn}},
            false, outline);
    return outline;
  }
  std::vector<Direction> vertices;
  std::ranges::transform(cell.vertices(), std::back_inserter(vertices), directionOf);
  const auto ring = unrolled(
      vertices, [&](std::size_t k) { return sideOf(sites, diagram, cell.index(), cell.begin() + k); });
  const Turns turns = turnsOf(ring);
  for (double turn = turns.first; turn <= turns.last; ++turn) {
    const auto part = within(ring, turn * whole_turn);
    if (part.size() >= 3) addRing(part, false, outline);
  }
  return outline;
}

}  // namespace

GreatArc core::sideOf(const Sites& sites, const Diagram& diagram, std::size_t site, std::uint64_t entry) {
  const Cell cell = diagram.cell(site);
  const CellRings rings = cell.rings();
  std::size_t ring = 0;
  while (entry >= rings.end(ring)) ++ring;
  const auto next = entry + 1 < rings.end(ring) ? entry + 1 : rings.begin(ring);
  const Direction begin = directionOf(diagram.vertices[entry]), end = directionOf(diagram.vertices[next]);
  // In an outline, sides are shorter than half a turn.
  if (!diagram.ring_starts.empty()) return shorterArc(begin, end);
  const auto neighbor = static_cast<std::size_t>(diagram.neighbors[entry]);
  return arcBetween(vectorOf(sites, site), vectorOf(sites, neighbor), begin, end, next == entry);
}

SpherePolygon core::sphereRingsOf(const Diagram& diagram, std::size_t site) {
  SpherePolygon found;
  const CellRings rings(diagram, site);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    auto& ring = found.emplace_back();
    std::ranges::transform(rings[r], std::back_inserter(ring), directionOf);
  }
  return found;
}

Outline core::polygonsInDegrees(const SpherePolygon& rings) {
  Outline outline;
  std::vector<std::vector<Point>> polygon;
  for (const auto& directions : rings) {
    auto ring = unrolled(directions, [&](std::size_t k) {
      return shorterArc(directions[k], directions[k + 1 < directions.size() ? k + 1 : 0]);
    });
    const bool is_hole =
        !polygon.empty() && (areaOfRing(ring) < 0 || (isAround(ring) && isAround(polygon.front())));
    if (!is_hole && !polygon.empty()) addCut(std::exchange(polygon, {}), outline);
    polygon.push_back(std::move(ring));
  }
  if (!polygon.empty()) addCut(std::move(polygon), outline);
  return outline;
}

Outline globePolygons(const Sites& sites, const Diagram& diagram, std::size_t site) {
  if (diagram.status[site] != Status::ok) return {};
  if (!diagram.ring_starts.empty()) return polygonsInDegrees(sphereRingsOf(diagram, site));
  return wholePolygons(sites, diagram, diagram.cell(site));
}

std::vector<Point> globeEdge(const Sites& sites, const Diagram& diagram, std::size_t site,
                             std::uint64_t edge) {
  UnrolledBorder line;
  line.add(sideOf(sites, diagram, site, edge));
  return std::move(line).line();
}

std::vector<Point> globeWay(Point from, Point to) {
  constexpr double opposite = 1e-8;
  const Direction begin = directionOf(from), end = directionOf(to), turn = cross(begin, end);
  const double angle = angleBetween(begin, end), sine = lengthOf(turn);
  // Between places opposite to each other any way is the shortest.
  const bool has_axis = sine > 0 && (sine > opposite || angle < 1);
  UnrolledBorder line;
  line.add({begin, end, has_axis ? 1 / sine * turn : perpendicular(begin), angle});
  return std::move(line).line();
}

std::vector<std::vector<Point>> cutAtTurns(const std::vector<Point>& line) {
  const double middle = line.size() < 2 ? line[0].x : (line[0].x + line[1].x) / 2;
  double turn = whole_turn * std::floor((middle + half_turn) / whole_turn);
  std::vector<std::vector<Point>> parts(1);
  const auto add = [&](Point p) { parts.back().push_back({p.x - turn, p.y}); };
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Point to = line[k];
    while (std::abs(to.x - turn) > half_turn) {
      const double side = std::copysign(1.0, to.x - turn), x = turn + side * half_turn;
      const Point from = line[k - 1];
      const double y = from.y + (to.y - from.y) * ((x - from.x) / (to.x - from.x));
      if (parts.back().empty() || parts.back().back() != Point{side * half_turn, y}) add({x, y});
      turn += side * whole_turn;
      parts.emplace_back();
      add({x, y});
    }
    add(to);
  }
  std::erase_if(parts, [](const auto& part) { return part.size() < 2; });
  return parts;
}

double globeDistance(Point from, Point to) {
  return earthRadius() * angleBetween(directionOf(from), directionOf(to));
}

Point3 onGlobe(Point degrees) {
  const Direction at = directionOf(degrees);
  return {at.x, at.y, at.z};
}

GlobeBorder globeBorder(const Sites& sites, const Diagram& diagram, std::size_t site, double longest) {
  const Cell cell = diagram.cell(site);
  GlobeBorder border;
  const auto add = [&](const Direction& at) { border.points.push_back({at.x, at.y, at.z}); };
  const auto addArc = [&](const GreatArc& arc) {
    border.begins.push_back(border.points.size());
    add(arc.begin);
    forEachPiece(arc, longest, add);
    border.points.pop_back();
  };
  if (cell.edges() == 0) {
    const Direction axis = directionOf({sites.x[site], sites.y[site]}), begin = perpendicular(axis);
    addArc({begin, begin, axis, whole_turn * degree});
    border.begins.clear();
  }
  for (auto entry = cell.begin(); entry < cell.end(); ++entry) addArc(sideOf(sites, diagram, site, entry));
  return border;
}

}  // namespace vorpipe
