#include "space/place.h"

#include <algorithm>

#include "base/double_double.h"
#include "base/processors.h"
#include "space/exact_signs.h"

namespace vorpipe::space {
namespace {

/// Where doubles suffice, and pairs of doubles.
constexpr double well_conditioned = 1e3, ill_conditioned = 0x1p40;

struct PairRow {
  DoubleDouble x, y, z, lift;
};

PairRow pairRow(const Places& places, Label site, Label other) {
  const Point3& from = places.sites[site];
  if (isWallLabel(other)) {
    const Relative wall = relative(places, site, other);
    const auto distance =
        DoubleDouble::sum(wallOffset(places, other), -coordinate(from, axisOf(wallOf(other))));
    const DoubleDouble out(isUpper(wallOf(other)) ? 2.0 : -2.0);
    return {DoubleDouble(wall.x), DoubleDouble(wall.y), DoubleDouble(wall.z), out * distance};
  }
  const Point3& to = places.sites[other];
  const auto x = DoubleDouble::sum(to.x, -from.x), y = DoubleDouble::sum(to.y, -from.y),
             z = DoubleDouble::sum(to.z, -from.z);
  const DoubleDouble squared = x * x + y * y + z * z;
  if (places.weights == nullptr) return {x, y, z, squared};
  return {x, y, z, squared + DoubleDouble::sum(places.weights[site], -places.weights[other])};
}

/// The formula of PlaceInDouble. Differences are exact; a sum has an error of 3 u^2, a product one of 6 u^2,
/// a quotient one of 16 u^2. As there, in all u^2 k (28 (|A| / m(a) + ...) + 50 |p|); without weights
/// |A| / m(a) <= 2 |p|. So up to k = 2^40 it is below 2^-58 |p|, and what remains is the last rounding.
FOR_FUSED_TOO Point3 placeByPairs(const Places& places, Label site, const std::array<Label, 3>& other) {
  const PairRow a = pairRow(places, site, other[0]), b = pairRow(places, site, other[1]),
                c = pairRow(places, site, other[2]);
  const auto minor = [](const DoubleDouble& px, const DoubleDouble& py, const DoubleDouble& qx,
                        const DoubleDouble& qy) { return px * qy - py * qx; };
  const auto ab_x = minor(a.y, a.z, b.y, b.z), ab_y = minor(a.z, a.x, b.z, b.x),
             ab_z = minor(a.x, a.y, b.x, b.y);
  const auto det = c.x * ab_x + c.y * ab_y + c.z * ab_z;
  const auto twice = det + det;
  const auto component = [&](const DoubleDouble& bc, const DoubleDouble& ca, const DoubleDouble& ab) {
    return static_cast<double>((a.lift * bc + b.lift * ca + c.lift * ab) / twice);
  };
  return {component(minor(b.y, b.z, c.y, c.z), minor(c.y, c.z, a.y, a.z), ab_x),
          component(minor(b.z, b.x, c.z, c.x), minor(c.z, c.x, a.z, a.x), ab_y),
          component(minor(b.x, b.y, c.x, c.y), minor(c.x, c.y, a.x, a.y), ab_z)};
}

/// Whether placeByPairs() is right to 2^-53 of the distance, by its error bound: weights may make a lift of
/// nearly 0 out of large numbers.
bool doPairsSuffice(const PlaceInDouble& near, const Relative& a, const Relative& b, const Relative& c) {
  if (!(near.condition < ill_conditioned)) return false;
  const double terms =
      28 * (a.lift_size / a.size() + b.lift_size / b.size() + c.lift_size / c.size()) + 50 * near.distance;
  return 0x1p-106 * near.condition * terms <= 0x1p-54 * near.distance;
}

}  // namespace

Point3 vertexPlace(const Places& places, Label i, Label j, Label k, Label l, double* error) {
  const Relative a = relative(places, i, j), b = relative(places, i, k), c = relative(places, i, l);
  const PlaceInDouble quick(a, b, c);
  // Weights may make a lift of nearly 0 out of large numbers.
  constexpr double well_known = 1e-11;
  const bool known = places.weights == nullptr || quick.error <= well_known * quick.distance;
  if (quick.condition < well_conditioned && known) {
    *error = quick.error;
    return quick.place;
  }
  const std::array<Label, 3> other{j, k, l};
  const bool by_pairs =
      places.weights == nullptr ? quick.condition < ill_conditioned : doPairsSuffice(quick, a, b, c);
  const Point3 p = by_pairs ? placeByPairs(places, i, other) : exactPlace(places, i, other);
  *error = 0x1p-51 * std::hypot(p.x, p.y, p.z);
  return p;
}

Point3 canonicalPlace(const Places& places, const std::array<Label, 4>& labels) {
  auto sorted = labels;
  std::ranges::sort(sorted, [&](Label a, Label b) {
    if (isWallLabel(a) || isWallLabel(b)) return isWallLabel(a) ? isWallLabel(b) && a < b : true;
    return places.sites[a] < places.sites[b];
  });
  if (places.weights != nullptr) {
    // A site may be far from a box that its cell reaches into: places relative to it would be worse.
    const auto nearest = std::ranges::min_element(sorted, {}, [&](Label label) {
      return isWallLabel(label) ? HUGE_VAL : distanceOutside(places, label);
    });
    std::rotate(sorted.begin(), nearest, nearest + 1);
  }
  double error = 0;
  const Point3 p = vertexPlace(places, sorted[0], sorted[1], sorted[2], sorted[3], &error);
  const Point3& site = places.sites[sorted[0]];
  Point3 place{site.x + p.x, site.y + p.y, site.z + p.z};
  for (const Label label : labels) {
    if (!isWallLabel(label)) continue;
    const int axis = axisOf(wallOf(label));
    (axis == 0 ? place.x : axis == 1 ? place.y : place.z) = wallOffset(places, label);
  }
  return place;
}

}  // namespace vorpipe::space
