/// Where vertices are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "space/label.h"
#include "space/relative.h"

namespace vorpipe::space {

/// The place of the vertex (i; j, k, l) relative to site i; orientation(i; j, k, l) must not be 0. It is as
/// near to that as `error` says (a distance): some 1e-11 of its own distance from the site where doubles do
/// for that, else 1e-15 of it, whatever the condition.
Point3 vertexPlace(const Places& places, Label i, Label j, Label k, Label l, double* error);

/// How far a site is outside of the box along an axis; 0 inside.
inline double distanceOutside(const Places& places, Label site) {
  const Point3& p = places.sites[site];
  const Box3& box = places.box;
  return std::max(
      {box.xmin - p.x, p.x - box.xmax, box.ymin - p.y, p.y - box.ymax, box.zmin - p.z, p.z - box.zmax, 0.0});
}

/// The place of the vertex of four labels, at least one of them a site, in the unit of the sites: the same
/// bits in whichever order they are. Coordinates on a wall are the wall's.
Point3 canonicalPlace(const Places& places, const std::array<Label, 4>& labels);

/// The vertex of three faces in double, relative to the site that sees these so.
struct PlaceInDouble {
  Point3 place;
  double distance;   ///< of that place from the site
  double condition;  ///< k = m(a) m(b) m(c) / |det(a, b, c)|, m: the sum of the magnitudes of components
  double error;      ///< a bound of the distance from the true place; infinite if there is none

  PlaceInDouble(const Relative& a, const Relative& b, const Relative& c);
};

/// p = (A (b x c) + B (c x a) + C (a x b)) / (2 det), A, B, C being the lifts. Let u = 2^-53. Of the
/// numerator each term has 13 factors (1 + e), |e| <= u: 4 of the minor, 6 of the lift, a product, 2 sums; so
/// that all three components together are off by 13 u (|A| m(b) m(c) + ...), |A| being the lift's size; det
/// by 8 u m(a) m(b) m(c); and a quotient is rounded once. This makes u k (6.5 (|A| / m(a) + ...) + 9 |p|),
/// and less than 8 and 10 for 6.5 and 9 if k < 1e7. Products must not underflow: m from 2^-150 to 2^150.
inline PlaceInDouble::PlaceInDouble(const Relative& a, const Relative& b, const Relative& c) {
  constexpr double u = 0x1p-53, well = 1e7, least = 0x1p-150, most = 0x1p150;
  const auto cross = [](const Relative& p, const Relative& q) {
    return Point3{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  };
  const Point3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double det = (c.x * ab.x + c.y * ab.y) + c.z * ab.z, half = 0.5 / det;
  place = {((a.lift * bc.x + b.lift * ca.x) + c.lift * ab.x) * half,
           ((a.lift * bc.y + b.lift * ca.y) + c.lift * ab.y) * half,
           ((a.lift * bc.z + b.lift * ca.z) + c.lift * ab.z) * half};
  distance = std::sqrt((place.x * place.x + place.y * place.y) + place.z * place.z);
  const double ma = a.size(), mb = b.size(), mc = c.size(), per_det = std::abs(half + half);
  const bool in_range = std::min({ma, mb, mc}) > least && std::max({ma, mb, mc}) < most;
  condition = in_range ? ma * mb * mc * per_det : HUGE_VAL;
  const double terms = a.lift_size * mb * mc + b.lift_size * mc * ma + c.lift_size * ma * mb;
  error = condition < well ? u * (8 * terms * per_det + 10 * condition * distance) : HUGE_VAL;
}

}  // namespace vorpipe::space
