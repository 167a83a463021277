#include "space/measures.h"

#include <algorithm>
#include <cmath>

#include "space/place.h"

namespace vorpipe::space {
namespace {

Point3 minus(const Point3& a, const Point3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

Point3 crossed(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Whether a site is so far outside of the box that places relative to it are worse than those in the box.
bool isFarOutside(const Places& places, Label site) {
  const Box3& box = places.box;
  const double side = std::min({box.xmax - box.xmin, box.ymax - box.ymin, box.zmax - box.zmin});
  return distanceOutside(places, site) > 4 * side;
}

}  // namespace

/// Places relative to a point in the middle, so that a small cell far from its site loses nothing.
void CarefulMeasures::takePlaces(Label site, const Row& row) {
  vertices_.number(row);
  place_.resize(vertices_.size());
  if (isFarOutside(places_, site)) {
    const Point3& from = places_.sites[site];
    Point3 first{};
    for (std::size_t v = 0; v < place_.size(); ++v) {
      const auto& faces = vertices_.faces()[v];
      const Point3 p = canonicalPlace(
          places_, {site, row.neighbor[faces[0]], row.neighbor[faces[1]], row.neighbor[faces[2]]});
      if (v == 0) first = p;
      place_[v] = minus(p, first);
    }
    origin_ = minus(first, from);
    return;
  }
  corners_.take(site, row);
  for (std::size_t v = 0; v < place_.size(); ++v) {
    const VertexPlace p = corners_.at(vertices_.faces()[v]);
    place_[v] = {p.x, p.y, p.z};
  }
  Point3 low = place_[0], high = place_[0];
  for (const auto& p : place_) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  origin_ = {(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
  for (auto& p : place_) p = minus(p, origin_);
}

/// Adds the tetrahedra of the origin and a fan of triangles.
void CarefulMeasures::addFace(const Ring& ring, std::size_t begin) {
  const auto& at_end = vertices_.atEnd();
  const Point3 a = place_[at_end[begin]];
  Point3 area{};
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const Point3 b = place_[at_end[begin + k]], c = place_[at_end[begin + k + 1]];
    const Point3 twice = crossed(minus(b, a), minus(c, a));
    area = {area.x + twice.x, area.y + twice.y, area.z + twice.z};
    const double six = (a.x * twice.x + a.y * twice.y) + a.z * twice.z;
    const Point3 s{a.x + b.x + c.x, a.y + b.y + c.y, a.z + b.z + c.z};
    six_volumes_ += six;
    first_[0] += six * s.x;
    first_[1] += six * s.y;
    first_[2] += six * s.z;
    moments_[0] += six * (a.x * a.x + b.x * b.x + c.x * c.x + s.x * s.x);
    moments_[1] += six * (a.y * a.y + b.y * b.y + c.y * c.y + s.y * s.y);
    moments_[2] += six * (a.z * a.z + b.z * b.z + c.z * c.z + s.z * s.z);
    moments_[3] += six * (a.y * a.z + b.y * b.z + c.y * c.z + s.y * s.z);
    moments_[4] += six * (a.x * a.z + b.x * b.z + c.x * c.z + s.x * s.z);
    moments_[5] += six * (a.x * a.y + b.x * b.y + c.x * c.y + s.x * s.y);
  }
  areas_.push_back(0.5 * std::sqrt((area.x * area.x + area.y * area.y) + area.z * area.z));
}

void CarefulMeasures::measure(Label site, const Row& row) {
  takePlaces(site, row);
  areas_.clear();
  six_volumes_ = 0;
  first_ = {};
  moments_ = {};
  for (std::size_t f = 0; f < row.faces; ++f) addFace(row.ring(f), row.ringBegin(f));
  double surface = 0;
  for (const double area : areas_) surface += area;
  const double volume = six_volumes_ / 6;
  const double part = six_volumes_ > 0 ? 0.25 / six_volumes_ : 0;
  // Rounding may put the centroid of a cell without thickness anywhere; it is no further out than vertices.
  double reach[3] = {};
  for (const auto& p : place_) {
    reach[0] = std::max(reach[0], std::abs(p.x));
    reach[1] = std::max(reach[1], std::abs(p.y));
    reach[2] = std::max(reach[2], std::abs(p.z));
  }
  const auto within = [&](std::size_t axis) {
    return std::clamp(first_[axis] * part, -reach[axis], reach[axis]);
  };
  const double x = within(0), y = within(1), z = within(2);
  constexpr double from_sixfold = 1.0 / 120;
  const double products[6] = {x * x, y * y, z * z, y * z, x * z, x * y};
  for (std::size_t e = 0; e < 6; ++e) moments_[e] = moments_[e] * from_sixfold - volume * products[e];
  measures_ = {volume, surface, {origin_.x + x, origin_.y + y, origin_.z + z}};
}

}  // namespace vorpipe::space
