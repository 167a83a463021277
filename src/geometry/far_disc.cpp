#include "geometry/far_disc.h"

#include <algorithm>
#include <cmath>

namespace vorpipe::core {
namespace {

DoubleDouble dot(Point a, Point b) {
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

}  // namespace

FarDisc::FarDisc(Point center, double squared_radius)
    : center_(center), origin_inwards_(DoubleDouble(squared_radius) - dot(center, center)) {}

double FarDisc::inwards(Point p) const {
  const DoubleDouble cross = dot(p, center_);
  return (origin_inwards_ + cross + cross - dot(p, p)).high;
}

/// (p - center) . way
double FarDisc::alongFromCenter(Point p, Point way) const { return (dot(p, way) - dot(center_, way)).high; }

Chord FarDisc::chordOf(const End& begin, const End& end) const {
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
  return {between(a, b, first), between(a, b, last), std::max(last - first, 0.0) * length, true, true, true};
}

}  // namespace vorpipe::core
