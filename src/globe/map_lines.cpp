// Arcs and cells as lines and rings of a map.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "domain/degrees.h"
#include "domain/rings.h"
#include "globe/sphere_map.h"
#include "vorpipe/cell.h"
#include "vorpipe/globe.h"

namespace vorpipe::core {
namespace {

/// In radians.
constexpr double half_circle = std::numbers::pi;
constexpr std::size_t fewest_corners = 3;
/// Directions as near to each other, or to a plane, are in the same place.
constexpr double same = 1e-12;
/// A flat map has no line through a place as near to a pole.
constexpr double beside_pole = 1e-9;

/// A part of an arc, by the angles from its beginning.
struct Stretch {
  double from, to;
};

/// The direction of an arc at an angle from its beginning.
Direction along(const GreatArc& arc, double angle) {
  if (angle == 0) return arc.begin;
  if (angle == arc.angle) return arc.end;
  return std::cos(angle) * arc.begin + std::sin(angle) * cross(arc.axis, arc.begin);
}

/// The angles of an arc at which it meets the plane at right angles to a direction, up to a whole turn.
std::vector<double> crossings(const GreatArc& arc, const Direction& normal) {
  const double a = dot(arc.begin, normal), b = dot(cross(arc.axis, arc.begin), normal);
  std::vector<double> found;
  if (std::hypot(a, b) < same) return found;
  for (double angle = std::atan2(-a, b) - 2 * half_circle; angle < arc.angle; angle += half_circle) {
    if (angle > 0) found.push_back(angle);
  }
  return found;
}

bool isAlongHorizon(const SphereMap& map, const GreatArc& arc) {
  return std::hypot(dot(arc.begin, map.viewer()), dot(cross(arc.axis, arc.begin), map.viewer())) < same;
}

bool isFacing(const SphereMap& map, const GreatArc& arc, Stretch stretch) {
  return dot(along(arc, (stretch.from + stretch.to) / 2), map.viewer()) >= -same;
}

/// The stretches of an arc between its crossings of the horizon.
std::vector<Stretch> betweenHorizons(const SphereMap& map, const GreatArc& arc) {
  std::vector<Stretch> stretches{{0, arc.angle}};
  for (const double angle : crossings(arc, map.viewer())) {
    stretches.back().to = angle;
    stretches.push_back({angle, arc.angle});
  }
  return stretches;
}

/// Those on the viewer's side of it.
std::vector<Stretch> facing(const SphereMap& map, const GreatArc& arc) {
  auto stretches = betweenHorizons(map, arc);
  std::erase_if(stretches, [&](Stretch stretch) { return !isFacing(map, arc, stretch); });
  return stretches;
}

/// The stretches of an arc between the antimeridian and the poles.
std::vector<Stretch> withoutTurns(const GreatArc& arc) {
  constexpr Direction east{0, 1, 0}, front{1, 0, 0};
  std::vector<double> cuts{0};
  const auto of_meridian = crossings(arc, east);
  // In the plane of that meridian only poles cut.
  const bool in_plane = of_meridian.empty() && std::abs(arc.begin.y) < same && std::abs(arc.end.y) < same;
  for (const double angle : in_plane ? crossings(arc, front) : of_meridian) {
    if (along(arc, angle).x < beside_pole) cuts.push_back(angle);
  }
  cuts.push_back(arc.angle);
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) stretches.push_back({cuts[k], cuts[k + 1]});
  return stretches;
}

bool isOnAntimeridian(const Direction& a) { return a.x < 0 && std::abs(a.y) < same; }

/// The place of an end of a stretch in degrees: on the side from which the stretch comes.
Point placeAtEnd(const Direction& end, const Direction& inside) {
  Point place = placeOf(end);
  const Point from = placeOf(inside);
  if (std::hypot(end.x, end.y) < beside_pole) return {from.x, std::copysign(quarter_turn, end.z)};
  if (isOnAntimeridian(end)) place.x = std::copysign(antimeridian, from.x);
  return place;
}

/// Draws a stretch of an arc as a line whose pieces are as good as straight.
class SmoothLine {
 public:
  SmoothLine(const SphereMap& map, const GreatArc& arc, Stretch stretch)
      : map_(map), arc_(arc), most_off_(part_of_box * map.shownWidth()) {
    const Direction inside = along(arc, (stretch.from + stretch.to) / 2);
    const Point first = end(along(arc, stretch.from), inside), last = end(along(arc, stretch.to), inside);
    points_.push_back(first);
    const auto steps = std::max(1, static_cast<int>(std::ceil((stretch.to - stretch.from) / longest)));
    Point from = first;
    double begin = stretch.from;
    for (int k = 1; k <= steps; ++k) {
      const double angle = k == steps ? stretch.to : stretch.from + (stretch.to - stretch.from) * k / steps;
      const Point to = k == steps ? last : placed(angle);
      add(begin, from, angle, to, 0);
      begin = angle;
      from = to;
    }
  }
  std::vector<Point> take() { return std::move(points_); }

 private:
  static constexpr double longest = 1.5 * degree, part_of_box = 1e-5;

  [[nodiscard]] Point end(const Direction& at, const Direction& inside) const {
    return map_.isFlat() ? map_.flat(placeAtEnd(at, inside)) : map_.seen(at);
  }
  [[nodiscard]] Point placed(double angle) const {
    const Direction at = along(arc_, angle);
    return map_.isFlat() ? map_.flat(placeOf(at)) : map_.seen(at);
  }
  void add(double begin, Point from, double angle, Point to, int depth) {
    constexpr int deepest = 24;
    const double middle = (begin + angle) / 2;
    const Point at = placed(middle);
    if (depth < deepest && std::hypot(at.x - (from.x + to.x) / 2, at.y - (from.y + to.y) / 2) > most_off_) {
      add(begin, from, middle, at, depth + 1);
      add(middle, at, angle, to, depth + 1);
    } else {
      points_.push_back(to);
    }
  }

  const SphereMap& map_;
  const GreatArc& arc_;
  double most_off_;
  std::vector<Point> points_;
};

/// A line along longitude 180, drawn at the left and at the right border of a flat map.
void addBothSides(const SphereMap& map, const GreatArc& arc, Stretch stretch,
                  std::vector<std::vector<Point>>& lines) {
  const auto steps =
      std::max(1, static_cast<int>(std::ceil((stretch.to - stretch.from) / (border_step * degree))));
  for (const double side : {-antimeridian, antimeridian}) {
    std::vector<Point>& line = lines.emplace_back();
    for (int k = 0; k <= steps; ++k) {
      const double angle = stretch.from + (stretch.to - stretch.from) * k / steps;
      line.push_back(map.flat({side, placeOf(along(arc, angle)).y}));
    }
  }
}

/// Adds the points of a line that are not yet the ring's last.
void append(const std::vector<Point>& line, std::vector<Point>& ring) {
  for (const Point& point : line) {
    if (ring.empty() || ring.back() != point) ring.push_back(point);
  }
}

/// The horizon from one direction counter-clockwise to another; none if they are as good as the same.
std::vector<Point> horizonBetween(const SphereMap& map, const Direction& from, const Direction& to) {
  if (lengthOf(to - from) < beside_pole) return {};
  double angle = std::atan2(dot(map.viewer(), cross(from, to)), dot(from, to));
  if (angle < 0) angle += 2 * half_circle;
  return SmoothLine(map, {from, to, map.viewer(), angle}, {0, angle}).take();
}

/// Whether a cell has the direction of the viewer.
bool holdsViewer(const SphereMap& map, const std::vector<Direction>& vectors, const Cell& cell) {
  return std::ranges::all_of(cell.neighbors(), [&](std::int64_t neighbor) {
    return dot(map.viewer(), vectors[static_cast<std::size_t>(neighbor)] - vectors[cell.index()]) <= 0;
  });
}

/// The ring around what the viewer sees of a cell. A cell is an intersection of halves of the sphere; that on
/// the viewer's side is one more.
std::vector<Point> seenRing(const SphereMap& map, const std::vector<Direction>& vectors,
                            const Diagram& diagram, std::size_t site) {
  const Cell cell = diagram.cell(site);
  std::vector<Point> ring;
  Direction first{}, last{};
  for (std::size_t e = 0; e < cell.edges(); ++e) {
    const GreatArc arc = arcOf(vectors, diagram, site, e);
    // The horizon closes the ring; of cells on either side one is seen.
    if (isAlongHorizon(map, arc)) continue;
    for (const Stretch stretch : facing(map, arc)) {
      const Direction from = along(arc, stretch.from);
      if (ring.empty()) {
        first = from;
      } else {
        append(horizonBetween(map, last, from), ring);
      }
      append(SmoothLine(map, arc, stretch).take(), ring);
      last = along(arc, stretch.to);
    }
  }
  if (!ring.empty()) {
    append(horizonBetween(map, last, first), ring);
  } else if (holdsViewer(map, vectors, cell)) {
    ring = map.border();
  }
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

/// Rings around what the viewer sees of a polygon. Its sides on the near half of the sphere are chains, each
/// from where it comes over the horizon to where it goes below. From there the horizon leads,
/// counter-clockwise as the inside lies to the left, to the next beginning of a chain.
class SeenPolygon {
 public:
  explicit SeenPolygon(const SphereMap& map) : map_(map) {}

  void add(const std::vector<Direction>& ring) {
    std::vector<Side> sides;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Direction &from = ring[k], &to = ring[k + 1 < ring.size() ? k + 1 : 0];
      const Direction turn = cross(from, to);
      if (!(lengthOf(turn) > 0)) continue;
      const GreatArc arc{from, to, normalized(turn), angleBetween(from, to)};
      for (const Stretch stretch : betweenHorizons(map_, arc))
        sides.push_back({arc, stretch, isFacing(map_, arc, stretch)});
    }
    const auto hidden = std::ranges::find(sides, false, &Side::is_seen);
    std::rotate(sides.begin(), hidden, sides.end());
    bool goes_on = hidden == sides.end();
    if (goes_on) rings_.emplace_back();
    for (const Side& side : sides) {
      const Direction from = along(side.arc, side.stretch.from), to = along(side.arc, side.stretch.to);
      if (side.is_seen && !goes_on) chains_.push_back({{}, from, to});
      goes_on = side.is_seen;
      if (!side.is_seen) continue;
      const bool is_whole = hidden == sides.end();
      append(SmoothLine(map_, side.arc, side.stretch).take(),
             is_whole ? rings_.back() : chains_.back().points);
      if (!is_whole) chains_.back().to = to;
    }
  }

  std::vector<std::vector<Point>> take() {
    while (!chains_.empty()) {
      std::vector<Point>& ring = rings_.emplace_back();
      const Direction begin = chains_.front().from;
      std::size_t next = 0;
      do {
        const Chain chain = std::move(chains_[next]);
        chains_.erase(chains_.begin() + static_cast<std::ptrdiff_t>(next));
        append(chain.points, ring);
        next = nextFrom(chain.to, begin);
        append(horizonBetween(map_, chain.to, next < chains_.size() ? chains_[next].from : begin), ring);
      } while (next < chains_.size());
    }
    for (auto& ring : rings_) {
      while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    }
    return std::move(rings_);
  }

 private:
  struct Side {
    GreatArc arc;
    Stretch stretch;
    bool is_seen;
  };
  struct Chain {
    std::vector<Point> points;
    Direction from, to;
  };

  /// The angle from one direction of the horizon counter-clockwise to another.
  [[nodiscard]] double angleOn(const Direction& from, const Direction& to) const {
    constexpr double rounding = 1e-9;
    const double angle = std::atan2(dot(map_.viewer(), cross(from, to)), dot(from, to));
    return angle < -rounding ? angle + 2 * half_circle : std::max(angle, 0.0);
  }

  /// The chain that begins next on the horizon; beyond the last of them if the ring's own beginning is
  /// nearer.
  [[nodiscard]] std::size_t nextFrom(const Direction& at, const Direction& begin) const {
    std::size_t next = chains_.size();
    double least = angleOn(at, begin);
    for (std::size_t k = 0; k < chains_.size(); ++k) {
      const double angle = angleOn(at, chains_[k].from);
      if (angle >= least) continue;
      least = angle;
      next = k;
    }
    return next;
  }

  const SphereMap& map_;
  std::vector<Chain> chains_;
  std::vector<std::vector<Point>> rings_;
};

/// A ring of degrees on a flat map. Its sides along the antimeridian are curves.
std::vector<Point> flatRing(const SphereMap& map, std::span<const Point> degrees) {
  std::vector<Point> ring;
  for (std::size_t k = 0; k < degrees.size(); ++k) {
    const Point from = degrees[k], to = degrees[k + 1 < degrees.size() ? k + 1 : 0];
    ring.push_back(map.flat(from));
    if (from.x != to.x || std::abs(from.x) != antimeridian) continue;
    const auto steps = static_cast<int>(std::ceil(std::abs(to.y - from.y) / border_step));
    for (int j = 1; j < steps; ++j) ring.push_back(map.flat({from.x, from.y + (to.y - from.y) * j / steps}));
  }
  return ring;
}

std::vector<std::vector<Point>> withArea(std::vector<std::vector<Point>> rings) {
  std::erase_if(rings, [](const auto& ring) { return ring.size() < fewest_corners; });
  return rings;
}

std::vector<std::vector<Point>> flatRings(const SphereMap& map, const Outline& degrees) {
  std::vector<std::vector<Point>> rings;
  for (std::size_t r = 0; r + 1 < degrees.ring_offsets.size(); ++r)
    rings.push_back(flatRing(map, ringAt(degrees, r)));
  return withArea(std::move(rings));
}

}  // namespace

std::vector<Direction> vectorsOf(const Sites& sites, int threads) {
  constexpr std::size_t grain = 1024;
  std::vector<Direction> vectors(sites.size());
  parallelEach(sites.size(), grain, threadCount(threads),
               [&](std::size_t i) { vectors[i] = vectorOf(sites, i); });
  return vectors;
}

GreatArc arcOf(const std::vector<Direction>& vectors, const Diagram& diagram, std::size_t site,
               std::size_t edge) {
  const Cell cell = diagram.cell(site);
  const auto vertices = cell.vertices();
  const std::size_t next = edge + 1 < vertices.size() ? edge + 1 : 0;
  return arcBetween(vectors[site], vectors[static_cast<std::size_t>(cell.neighbors()[edge])],
                    directionOf(vertices[edge]), directionOf(vertices[next]), next == edge);
}

std::vector<std::vector<Point>> linesOf(const SphereMap& map, const GreatArc& arc) {
  std::vector<std::vector<Point>> lines;
  for (const Stretch stretch : map.isFlat() ? withoutTurns(arc) : facing(map, arc)) {
    if (map.isFlat() && isOnAntimeridian(along(arc, (stretch.from + stretch.to) / 2))) {
      addBothSides(map, arc, stretch, lines);
    } else {
      lines.push_back(SmoothLine(map, arc, stretch).take());
    }
  }
  return lines;
}

std::vector<std::vector<Point>> ringsOf(const SphereMap& map, const SpherePolygon& polygon) {
  if (map.isFlat()) return flatRings(map, polygonsInDegrees(polygon));
  SeenPolygon seen(map);
  for (const auto& ring : polygon) seen.add(ring);
  return withArea(seen.take());
}

std::vector<std::vector<Point>> ringsOf(const SphereMap& map, const Sites& sites,
                                        const std::vector<Direction>& vectors, const Diagram& diagram,
                                        std::size_t site) {
  if (diagram.status[site] != Status::ok) return {};
  if (!diagram.ring_starts.empty()) return ringsOf(map, sphereRingsOf(diagram, site));
  if (map.isFlat()) return flatRings(map, globePolygons(sites, diagram, site));
  return withArea({seenRing(map, vectors, diagram, site)});
}

}  // namespace vorpipe::core
