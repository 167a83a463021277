#include "geometry/disc_cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/double_double.h"
#include "geometry/polygon_measures.h"

namespace vorpipe::core {
namespace {

constexpr double pi = std::numbers::pi;

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

Point onLine(const EdgeLine& line, double along) {
  return {line.distance * line.normal.x - along * line.normal.y,
          line.distance * line.normal.y + along * line.normal.x};
}

/// Position along the line, from its point nearest to the center.
double alongLine(const EdgeLine& line, Point p) { return line.normal.x * p.y - line.normal.y * p.x; }

/// Half the length of the infinite line inside the disc; 0 if the line misses it.
double halfChord(const EdgeLine& line, double squared_radius) {
  return std::sqrt(std::max(std::fma(-line.distance, line.distance, squared_radius), 0.0));
}

DoubleDouble wideDot(Point a, Point b) {
  return DoubleDouble::product(a.x, b.x) + DoubleDouble::product(a.y, b.y);
}

Point between(Point a, Point b, double part) { return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)}; }

/// For a chord that begins inside: the fraction of the way, 0 to 1, after which it leaves the disc. `along`
/// is alongFromCenter() at its beginning, and `squared` the squared length of the way.
double partUntilOutside(double inwards, double along, double squared) {
  const double root = std::sqrt(std::max(along * along + squared * inwards, 0.0));
  const double part = along > 0 ? inwards / (along + root) : (root - along) / squared;
  return std::clamp(part, 0.0, 1.0);
}

/// A disc much larger than a polygon, whose center is far away. Locates the circle to some 1e-16 of the
/// polygon, not of the disc: the gap between the polygon's corners and the circle is a difference of two
/// large squares, computed in double-double.
class FarDisc {
 public:
  /// `center` is relative to an origin near the polygon, as the polygon's corners are.
  FarDisc(Point center, double squared_radius)
      : center_(center), origin_inwards_(DoubleDouble(squared_radius) - wideDot(center, center)) {}

  struct End {
    Point place;
    double inwards;  ///< squared_radius - |place - center|^2: negative outside of the disc
  };
  [[nodiscard]] End endAt(Point p) const {
    const DoubleDouble cross = wideDot(p, center_);
    return {p, (origin_inwards_ + cross + cross - wideDot(p, p)).high};
  }

  [[nodiscard]] Chord chordOf(const End& begin, const End& end) const {
    const bool enters = begin.inwards < 0, leaves = end.inwards < 0;
    const Point a = begin.place, b = end.place, way{b.x - a.x, b.y - a.y}, back{-way.x, -way.y};
    const double squared = way.x * way.x + way.y * way.y, length = std::sqrt(squared);
    if (!enters && !leaves) return {a, b, length, false, false, true};
    if (!enters) {
      const double part = partUntilOutside(begin.inwards, alongFromCenter(a, way), squared);
      return {a, between(a, b, part), part * length, false, true, true};
    }
    if (!leaves) {
      const double part = partUntilOutside(end.inwards, alongFromCenter(b, back), squared);
      return {between(b, a, part), b, part * length, true, false, true};
    }
    const double along = alongFromCenter(a, way), root_of = along * along + squared * begin.inwards;
    if (!(along < 0 && along + squared > 0 && root_of > 0)) return {};
    const double root = std::sqrt(root_of);
    const double first = std::max((-along - root) / squared, 0.0),
                 last = std::min((root - along) / squared, 1.0);
    return {
        between(a, b, first), between(a, b, last), std::max(last - first, 0.0) * length, true, true, true};
  }

 private:
  /// (p - center) . way
  [[nodiscard]] double alongFromCenter(Point p, Point way) const {
    return (wideDot(p, way) - wideDot(center_, way)).high;
  }

  Point center_;
  DoubleDouble origin_inwards_;
};

/// Integrals over the segment of a disc of radius 1. x runs along the chord, from its middle; y runs away
/// from the center, from the chord.
struct Integrals {
  double one, y, xx, yy;
};

/// With a = half_angle and x = sin u, for -a <= u <= a, the height of a segment is cos u - cos a. The
/// integrals of its powers are sums of these terms.
Integrals closedIntegrals(double a) {
  const double sin2 = std::sin(2 * a), sin4 = std::sin(4 * a), cosine = std::cos(a);
  return {a - sin2 / 2, 0.75 * std::sin(a) + std::sin(3 * a) / 12 - a * cosine,
          (a - sin2 * 2 / 3 + sin4 / 12) / 4, 0.75 * a + a * std::cos(2 * a) / 2 - sin2 * 7 / 12 - sin4 / 48};
}

/// The same by Taylor's series of the sines and cosines, up to the power `last` of the angle: their first
/// powers, which would cancel, are left out. For angles up to 1.
Integrals seriesOfIntegrals(double a) {
  constexpr int last = 33;
  Integrals sum{0, 0, 0, 0};
  double term = a;                      // +-a^n / n!
  double two = 2, three = 3, four = 4;  // to the power n
  for (int n = 3; n <= last; n += 2) {
    term *= -a * a / ((n - 1) * n);
    two *= 4;
    three *= 9;
    four *= 16;
    sum.one -= term * two / 2;
    if (n >= 5) {
      sum.y += term * (9 + three - 12 * n) / 12;
      sum.xx += term * (four - 8 * two) / 48;
    }
    if (n >= 7) sum.yy += term * ((12 * n - 28) * two - four) / 48;
  }
  return sum;
}

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

EdgeLine lineThrough(Point a, Point b) {
  const double x = b.x - a.x, y = b.y - a.y, length = std::hypot(x, y);
  if (!(length > 0)) return {{0, 0}, 0};
  const DoubleDouble twice_area = DoubleDouble::product(a.x, b.y) - DoubleDouble::product(a.y, b.x);
  return {{y / length, -x / length}, twice_area.high / length};
}

Chord chordOf(const EdgeLine& line, const EdgeEnd& begin, const EdgeEnd& end, double squared_radius) {
  const double first = alongLine(line, begin.place), last = alongLine(line, end.place);
  const double half = halfChord(line, squared_radius);
  if (!begin.inside && !end.inside && !(half > 0 && first < 0 && last > 0)) return {};
  // Rounding may place an end on the wrong side of the crossing of edge and circle.
  const double from = begin.inside ? first : std::min(-half, end.inside ? last : half);
  const double to = end.inside ? last : std::max(half, from);
  return {begin.inside ? begin.place : onLine(line, from),
          end.inside ? end.place : onLine(line, to),
          std::max(to - from, 0.0),
          !begin.inside,
          !end.inside,
          true};
}

SegmentMeasures measureSegment(double radius, double half_angle) {
  const Integrals of = half_angle < 1 ? seriesOfIntegrals(half_angle) : closedIntegrals(half_angle);
  if (!(of.one > 0)) return {0, 0, 0, 0};
  const double height = of.y / of.one, squared = radius * radius, fourth = squared * squared;
  return {squared * of.one, radius * height, fourth * of.xx, fourth * (of.yy - of.y * height)};
}

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
  FarDisc::End begin = disc.endAt(corners[0]);
  const FarDisc::End first = begin;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const FarDisc::End end = k + 1 < corners.size() ? disc.endAt(corners[k + 1]) : first;
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
