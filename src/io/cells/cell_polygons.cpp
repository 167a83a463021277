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
  for (const Ring& ring : ringsOf(diagram, site)) {
    const auto vertices = verticesOf(diagram, ring);
    auto round = system.middle ? roundOf(vertices, *system.middle) : std::nullopt;
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
