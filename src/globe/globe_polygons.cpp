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

/// A ring of longitudes and latitudes. Longitudes continue from point to point, beyond half a turn if
/// necessary.
class UnrolledBorder {
 public:
  /// Adds the arc's points after its first.
  void add(const Arc& arc) {
    if (points_.empty()) points_.push_back(placeOf(arc.begin));
    // Both cells of an edge get the same points.
    const bool forward = arc.begin < arc.end;
    const auto pieces = static_cast<int>(std::ceil(arc.angle / (longest * degree)));
    for (int k = 0; k < pieces; ++k) {
      const auto at = [&](int piece) {
        if (piece == 0) return arc.begin;
        if (piece == pieces) return arc.end;
        if (forward) return pointOn(arc, static_cast<double>(piece) / pieces);
        const Arc back{arc.end, arc.begin, -arc.axis, arc.angle};
        return pointOn(back, static_cast<double>(pieces - piece) / pieces);
      };
      addPiece(at(k), at(k + 1), arc.axis.z);
    }
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
  static constexpr double longest = 0.5;    ///< degrees between points
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
  const auto neighbors = cell.neighbors();
  const Direction own = vectorOf(sites, site);
  // A ring begins elsewhere than at a pole, where it would have no longitude.
  std::size_t first = 0;
  while (first + 1 < vertices.size() && std::abs(vertices[first].y) == quarter_turn) ++first;
  const auto arcAt = [&](std::size_t k) {
    const auto e = (first + k) % vertices.size(), next = (e + 1) % vertices.size();
    return arcBetween(own, vectorOf(sites, static_cast<std::size_t>(neighbors[e])), directionOf(vertices[e]),
                      directionOf(vertices[next]), next == e);
  };
  UnrolledBorder border;
  const Arc start = arcAt(0);
  const bool from_pole = std::abs(vertices[first].y) == quarter_turn;
  const Direction between = pointOn(start, some_part);
  border.add(from_pole ? Arc{between, start.end, start.axis, (1 - some_part) * start.angle} : start);
  for (std::size_t k = 1; k < vertices.size(); ++k) border.add(arcAt(k));
  if (from_pole) border.add({start.begin, between, start.axis, some_part * start.angle});
  return border.polygons();
}

}  // namespace vorpipe
