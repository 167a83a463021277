#include "geometry/disc_cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/far_disc.h"
#include "geometry/polygon_measures.h"
#include "geometry/segment.h"

namespace vorpipe::core {
namespace {

constexpr double pi = std::numbers::pi;

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

/// The angle by which a polygon turns from an edge to the next: 0 to pi, because it is convex.
double turnBetween(const EdgeLine& edge, const EdgeLine& next) {
  const double angle = std::atan2(cross(edge.normal, next.normal), dot(edge.normal, next.normal));
  return angle < -pi / 2 ? pi : std::max(angle, 0.0);
}

/// Half the angle that the line cuts off the whole circle; more than pi / 2 if the center is on the line's
/// outer side.
double halfTaken(const EdgeLine& line, double squared_radius) {
  return std::atan2(halfChord(line, squared_radius), line.distance);
}

/// Half the angle that it leaves: pi minus that, but with all digits of small angles.
double halfLeft(const EdgeLine& line, double squared_radius) {
  return std::atan2(halfChord(line, squared_radius), -line.distance);
}

/// The angle of the arc from where edge `from` leaves the disc, at `begin`, to where another edge, `to`,
/// enters it, at `end`.
double arcBetween(std::span<const EdgeLine> lines, std::size_t from, std::size_t to, Point begin, Point end,
                  double squared_radius) {
  const double angle = std::atan2(cross(begin, end), dot(begin, end));
  constexpr double surely_not_a_whole_turn = 0.1;
  if (angle > surely_not_a_whole_turn) return angle;
  // Except for rounding, nothing and a whole turn look the same; the edges between decide which it is.
  double rough = 0;
  for (auto e = from; e != to;) {
    const auto next = e + 1 < lines.size() ? e + 1 : 0;
    rough += turnBetween(lines[e], lines[next]);
    e = next;
  }
  rough -= halfTaken(lines[from], squared_radius) + halfTaken(lines[to], squared_radius);
  return rough > angle + pi ? angle + 2 * pi : std::max(angle, 0.0);
}

}  // namespace

bool DiscCut::isFar(std::span<const Point> corners, double squared_radius) {
  constexpr double much_larger = 8;
  double extent = 0;
  for (const Point p : corners) {
    extent = std::max({extent, std::abs(p.x - corners[0].x), std::abs(p.y - corners[0].y)});
  }
  return squared_radius > much_larger * much_larger * extent * extent;
}

double DiscCut::arcAngle() const {
  double sum = 0;
  for (const Arc& arc : arcs_) sum += arc.angle;
  return sum;
}

/// Calls take(k, m) wherever the circle runs through the polygon, from the end of chord k to the beginning of
/// chord m.
template <class Take>
void DiscCut::eachGap(const Take& take) const {
  const auto count = chords_.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (!chords_[k].leaves) continue;
    auto m = k;
    do m = m + 1 < count ? m + 1 : 0;
    while (!chords_[m].enters && m != k);
    take(k, m);
  }
}

DiscShape DiscCut::cut(std::span<const Point> corners, std::span<const EdgeLine> lines,
                       double squared_radius) {
  arcs_.clear();
  chords_.clear();
  if (!(squared_radius > 0)) return DiscShape::nothing;
  bool all_inside = true, any_crossing = false;
  EdgeEnd begin = endAt(corners[0], squared_radius);
  const EdgeEnd first = begin;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const EdgeEnd end = k + 1 < corners.size() ? endAt(corners[k + 1], squared_radius) : first;
    chords_.push_back(chordOf(lines[k], begin, end, squared_radius));
    all_inside = all_inside && begin.inside;
    any_crossing = any_crossing || chords_.back().leaves;
    begin = end;
  }
  if (all_inside) return DiscShape::polygon;
  const double radius = std::sqrt(squared_radius);
  if (any_crossing) {
    findArcs(lines, squared_radius);
  } else {
    const auto is_outer = [](const EdgeLine& line) { return line.distance < 0; };
    if (std::ranges::any_of(lines, is_outer)) return DiscShape::nothing;
    arcs_.push_back({{radius, 0}, {radius, 0}, 2 * pi, Arc::no_edge});
  }
  measure(radius);
  return area_ > 0 ? DiscShape::part : DiscShape::nothing;
}

DiscShape DiscCut::cutFar(std::span<const Point> corners, Point center, double squared_radius) {
  arcs_.clear();
  chords_.clear();
  const FarDisc disc(center, squared_radius);
  bool all_inside = true, any_crossing = false;
  const auto end_at = [&](Point p) { return FarDisc::End{p, disc.inwards(p)}; };
  FarDisc::End begin = end_at(corners[0]);
  const FarDisc::End first = begin;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const FarDisc::End end = k + 1 < corners.size() ? end_at(corners[k + 1]) : first;
    chords_.push_back(disc.chordOf(begin, end));
    all_inside = all_inside && !(begin.inwards < 0);
    any_crossing = any_crossing || chords_.back().leaves;
    begin = end;
  }
  if (all_inside) return DiscShape::polygon;
  if (!any_crossing) return DiscShape::nothing;
  const double radius = std::sqrt(squared_radius);
  findFarArcs(radius);
  measure(radius);
  return area_ > 0 ? DiscShape::part : DiscShape::nothing;
}

void DiscCut::findArcs(std::span<const EdgeLine> lines, double squared_radius) {
  eachGap([&](std::size_t k, std::size_t m) {
    const Point begin = chords_[k].to, end = chords_[m].from;
    const double angle =
        k == m ? 2 * halfLeft(lines[k], squared_radius) : arcBetween(lines, k, m, begin, end, squared_radius);
    arcs_.push_back({begin, end, angle, static_cast<std::uint32_t>(k)});
  });
}

/// Arcs of a far disc are short.
void DiscCut::findFarArcs(double radius) {
  eachGap([&](std::size_t k, std::size_t m) {
    const Point begin = chords_[k].to, end = chords_[m].from;
    const double chord = lengthOf({end.x - begin.x, end.y - begin.y});
    arcs_.push_back(
        {begin, end, 2 * std::asin(std::min(chord / (2 * radius), 1.0)), static_cast<std::uint32_t>(k)});
  });
}

/// Adds the polygon whose corners are the ends of chords, with positions relative to one of them.
void DiscCut::addPolygon() {
  polygon_.clear();
  Point origin{0, 0};
  const auto add = [&](Point p) {
    if (polygon_.empty()) origin = p;
    polygon_.push_back({p.x - origin.x, p.y - origin.y});
  };
  for (const Chord& chord : chords_) {
    if (!chord.is_there) continue;
    add(chord.from);
    if (chord.leaves) add(chord.to);
  }
  if (polygon_.size() < 3) return;
  const Measures m = measurePolygon(polygon_);
  if (m.area > 0)
    parts_.push_back({m.area, {origin.x + m.centroid.x, origin.y + m.centroid.y}, m.second_moments});
}

/// Adds the segment between an arc and its chord.
void DiscCut::addSegment(const Arc& arc, double radius) {
  const double half_angle = arc.angle / 2;
  const SegmentMeasures m = measureSegment(radius, half_angle);
  if (!(m.area > 0)) return;
  const Point sum{arc.from.x + arc.to.x, arc.from.y + arc.to.y};
  const Point way{arc.to.x - arc.from.x, arc.to.y - arc.from.y};
  // Away from the center; the chord of nearly a whole turn is too short to tell the direction.
  const bool is_short = half_angle > 0.75 * pi;
  const Point normal = is_short ? Point{-sum.x, -sum.y} : Point{way.y, -way.x};
  const double length = lengthOf(normal), x = normal.x / length, y = normal.y / length;
  const double turned = m.across - m.along;
  parts_.push_back({m.area,
                    {sum.x / 2 + m.height * x, sum.y / 2 + m.height * y},
                    {m.along + turned * x * x, turned * x * y, m.along + turned * y * y}});
}

void DiscCut::addUp() {
  area_ = 0;
  second_ = {};
  Point moment{0, 0};  // about the first part's centroid
  for (const Part& part : parts_) {
    area_ += part.area;
    moment.x += part.area * (part.centroid.x - parts_[0].centroid.x);
    moment.y += part.area * (part.centroid.y - parts_[0].centroid.y);
  }
  if (!(area_ > 0)) return;
  centroid_ = {parts_[0].centroid.x + moment.x / area_, parts_[0].centroid.y + moment.y / area_};
  for (const Part& part : parts_) {
    const Point way{part.centroid.x - centroid_.x, part.centroid.y - centroid_.y};
    second_[0] += part.second[0] + part.area * way.x * way.x;
    second_[1] += part.second[1] + part.area * way.x * way.y;
    second_[2] += part.second[2] + part.area * way.y * way.y;
  }
}

void DiscCut::measure(double radius) {
  parts_.clear();
  addPolygon();
  for (const Arc& arc : arcs_) addSegment(arc, radius);
  addUp();
}

}  // namespace vorpipe::core
