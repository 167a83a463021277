#include <algorithm>
#include <cmath>
#include <vector>

#include "domain/degrees.h"
#include "globe/sphere_cells.h"
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
void forEachPiece(const Arc& arc, double longest, const Add& add) {
  const bool forward = arc.begin == arc.end ? arc.axis < -arc.axis : arc.begin < arc.end;
  const Arc back{arc.end, arc.begin, -arc.axis, arc.angle};
  const auto pieces = std::max(1, static_cast<int>(std::ceil(arc.angle / (longest * degree))));
  for (int k = 1; k < pieces; ++k) {
    const double part = static_cast<double>(forward ? k : pieces - k) / pieces;
    add(pointOn(forward ? arc : back, part));
  }
  add(arc.end);
}

/// An edge of a cell, by its number there.
Arc edgeArc(const Sites& sites, const Cell& cell, std::size_t k) {
  const auto vertices = cell.vertices();
  const std::size_t next = k + 1 < vertices.size() ? k + 1 : 0;
  return arcBetween(vectorOf(sites, cell.index()),
                    vectorOf(sites, static_cast<std::size_t>(cell.neighbors()[k])), directionOf(vertices[k]),
                    directionOf(vertices[next]), next == k);
}

/// A ring, or a line, of longitudes and latitudes. Longitudes continue from point to point, beyond half a
/// turn if necessary.
class UnrolledBorder {
 public:
  /// Adds the arc's points after its first.
  void add(const Arc& arc) {
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
    }
    return std::move(points_);
  }

  /// The polygons of the ring, cut at longitude 180.
  [[nodiscard]] std::vector<std::vector<Point>> polygons() {
    const double turns = std::round((points_.back().x - points_.front().x) / whole_turn);
    if (turns == 0) {
      points_.pop_back();
    } else {
      const double pole = turns > 0 ? quarter_turn : -quarter_turn;
      points_.push_back({points_.back().x, pole});
      points_.push_back({points_.front().x, pole});
    }
    const auto [west, east] = std::ranges::minmax(points_, {}, &Point::x);
    std::vector<std::vector<Point>> parts;
    const double first = std::floor((west.x + half_turn) / whole_turn);
    for (double turn = first; turn * whole_turn - half_turn < east.x; ++turn) {
      auto part = within(turn * whole_turn);
      if (part.size() >= 3) parts.push_back(std::move(part));
    }
    return parts;
  }

 private:
  static constexpr double longest = 0.25;   ///< degrees between points
  static constexpr double most_off = 1e-5;  ///< of the Earth's radius
  static constexpr double at_pole = 1e-12;

  static bool isPole(const Direction& a) { return std::hypot(a.x, a.y) <= at_pole; }

  /// Adds the places after `a` up to `b`, which is near, along an arc that runs east if `east` is positive.
  void addPiece(const Direction& a, const Direction& b, double east) {
    const Direction middle = normalized(a + b);
    const Point from = placeOf(a), to = placeOf(b);
    const bool at_a_pole = isPole(a) || isPole(b);
    const double way = std::remainder(to.x - from.x, whole_turn);
    const Direction chord = directionOf({from.x + way / 2, (from.y + to.y) / 2});
    if (!at_a_pole && lengthOf(chord - middle) > most_off) {
      addPiece(a, middle, east);
      addPiece(middle, b, east);
    } else {
      addPlace(b, east);
    }
  }

  void addPlace(const Direction& at, double east) {
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
    points_.push_back({last.x + way, place.y});
  }

  /// The part of the ring within half a turn of a longitude, which becomes 0.
  [[nodiscard]] std::vector<Point> within(double longitude) const {
    std::vector<Point> ring = points_;
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
    const auto last = std::ranges::unique(ring);
    ring.erase(last.begin(), last.end());
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    const bool has_width =
        !ring.empty() && std::ranges::any_of(ring, [&](Point p) { return p.x != ring[0].x; });
    return has_width ? ring : std::vector<Point>{};
  }

  std::vector<Point> points_;
};

}  // namespace

std::vector<std::vector<Point>> globePolygons(const Sites& sites, const Diagram& diagram, std::size_t site) {
  if (diagram.status[site] != Status::ok) return {};
  const Cell cell = diagram.cell(site);
  if (cell.edges() == 0) {
    return {{{-half_turn, -quarter_turn},
             {half_turn, -quarter_turn},
             {half_turn, quarter_turn},
             {-half_turn, quarter_turn}}};
  }
  const auto vertices = cell.vertices();
  // A ring begins elsewhere than at a pole, where it would have no longitude.
  std::size_t first = 0;
  while (first + 1 < vertices.size() && std::abs(vertices[first].y) == quarter_turn) ++first;
  const auto arcAt = [&](std::size_t k) { return edgeArc(sites, cell, (first + k) % vertices.size()); };
  UnrolledBorder border;
  const Arc start = arcAt(0);
  const bool from_pole = std::abs(vertices[first].y) == quarter_turn;
  const Direction between = pointOn(start, some_part);
  border.add(from_pole ? Arc{between, start.end, start.axis, (1 - some_part) * start.angle} : start);
  for (std::size_t k = 1; k < vertices.size(); ++k) border.add(arcAt(k));
  if (from_pole) border.add({start.begin, between, start.axis, some_part * start.angle});
  return border.polygons();
}

std::vector<Point> globeEdge(const Sites& sites, const Diagram& diagram, std::size_t site,
                             std::uint64_t edge) {
  const Cell cell = diagram.cell(site);
  UnrolledBorder line;
  line.add(edgeArc(sites, cell, edge - cell.begin()));
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

SpacePoint onGlobe(Point degrees) {
  const Direction at = directionOf(degrees);
  return {at.x, at.y, at.z};
}

GlobeBorder globeBorder(const Sites& sites, const Diagram& diagram, std::size_t site, double longest) {
  const Cell cell = diagram.cell(site);
  GlobeBorder border;
  const auto add = [&](const Direction& at) { border.points.push_back({at.x, at.y, at.z}); };
  const auto addArc = [&](const Arc& arc) {
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
  for (std::size_t k = 0; k < cell.edges(); ++k) addArc(edgeArc(sites, cell, k));
  return border;
}

}  // namespace vorpipe
