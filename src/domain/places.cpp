// Places on the Earth: validity, projections centered among them, and conversion to the plane.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "domain/degrees.h"
#include "domain/rings.h"
#include "geometry/polygon_measures.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr std::size_t places_grain = 1 << 12;

/// False for NaN.
bool isPlace(Point degrees) {
  return std::abs(degrees.x) <= whole_turn && std::abs(degrees.y) <= quarter_turn;
}

tl::unexpected<Error> noPlace(Subject subject, const std::string& what, Point degrees) {
  return tl::unexpected(refusalOf(
      subject,
      fmt::format("{} at {}, {} is no place on the Earth: a longitude is within {} degrees of 0, a latitude "
                  "within {}",
                  what, degrees.x, degrees.y, whole_turn, quarter_turn)));
}

/// From the center of the Earth, in units of its radius.
using SpacePoint = std::array<double, 3>;

SpacePoint inSpace(Point degrees) {
  const double x = degrees.x * degree, y = degrees.y * degree;
  return {std::cos(y) * std::cos(x), std::cos(y) * std::sin(x), std::sin(y)};
}

/// The place in this direction from the center of the Earth; degrees. Nothing for the center itself.
std::optional<Point> placeToward(const SpacePoint& at) {
  constexpr double least = 1e-9;
  const double across = std::hypot(at[0], at[1]);
  if (across >= least) return Point{std::atan2(at[1], at[0]) / degree, std::atan2(at[2], across) / degree};
  // At a pole any longitude will do.
  if (std::abs(at[2]) >= least) return Point{0, std::copysign(quarter_turn, at[2])};
  return {};
}

/// The bounding box of places in space.
class SpaceBox {
 public:
  void add(Point degrees) {
    const SpacePoint at = inSpace(degrees);
    for (std::size_t k = 0; k < at.size(); ++k) {
      low_[k] = std::min(low_[k], at[k]);
      high_[k] = std::max(high_[k], at[k]);
    }
  }

  /// The place of its middle. Nothing: places are all around the Earth.
  [[nodiscard]] std::optional<Point> middle() const {
    return placeToward({low_[0] + high_[0], low_[1] + high_[1], low_[2] + high_[2]});
  }

 private:
  SpacePoint low_ = {1, 1, 1}, high_ = {-1, -1, -1};
};

/// The middle of the region to the left of a ring that goes around the Earth, such as a hemisphere.
std::optional<Point> middleLeftOf(std::span<const Point> ring) {
  SpacePoint sum{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const SpacePoint a = inSpace(ring[i]), b = inSpace(core::nextOf(ring, i));
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const std::size_t next = (k + 1) % sum.size(), last = (k + 2) % sum.size();
      sum[k] += a[next] * b[last] - a[last] * b[next];
    }
  }
  return placeToward(sum);
}

Result<Projection> projectionNear(Point middle) {
  constexpr double steps = 100;  // of a degree
  const auto rounded = [](double degrees) { return std::round(degrees * steps) / steps + 0.0; };
  return Projection::around({rounded(middle.x), rounded(middle.y)});
}

/// The whole turns, in degrees, that bring a longitude next to another one.
double turnsTo(double longitude, double other) {
  return whole_turn * std::round((other - longitude) / whole_turn);
}

/// Number of edges that cross the meridian opposite to the center.
std::size_t jumpsOf(std::span<const Point> ring) {
  std::size_t jumps = 0;
  core::eachSide(ring, [&](Point a, Point b) { jumps += std::abs(b.x - a.x) > whole_turn / 2 ? 1u : 0u; });
  return jumps;
}

struct Longitudes {
  double least, most;
  [[nodiscard]] double middle() const { return least + (most - least) / 2; }
};

Longitudes longitudesOf(std::span<const Point> ring) {
  const auto [least, most] = std::ranges::minmax(ring, {}, &Point::x);
  return {least.x, most.x};
}

void turn(std::span<Point> points, double degrees) {
  for (Point& point : points) point.x += degrees;
}

/// Makes the longitudes of a cell, which are within a half turn of the center's, continuous along its rings.
/// They are then in the turn in which the cell contains its site of longitude `site`, if there is one; its
/// centroids move along. A ring around a pole stays as it is: one of its edges leads from one side of that
/// meridian to the other.
void joinTurns(double site, std::size_t cell, Diagram& diagram) {
  const CellRings rings = diagram.cell(cell).rings();
  std::optional<double> place;  ///< longitude of the cell, once known
  bool joined = false;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::size_t jumps = jumpsOf(rings[r]);
    if (jumps == 0 || jumps % 2 == 1) continue;
    const auto ring = std::span(diagram.vertices).subspan(rings.begin(r), rings[r].size());
    for (std::size_t k = 1; k < ring.size(); ++k) ring[k].x += turnsTo(ring[k].x, ring[k - 1].x);
    joined = true;
    const auto [least, most] = longitudesOf(ring);
    const double near = site + turnsTo(site, (least + most) / 2);
    const bool holds_site = near >= least && near <= most;
    if (!place && holds_site) place = site;
  }
  if (!joined) return;
  const std::uint64_t begin = diagram.cell_offsets[cell];
  const auto all = std::span(diagram.vertices).subspan(begin, diagram.cell_offsets[cell + 1] - begin);
  if (!place) place = longitudesOf(all).middle();
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const auto ring = std::span(diagram.vertices).subspan(rings.begin(r), rings[r].size());
    if (jumpsOf(ring) == 0) turn(ring, turnsTo(longitudesOf(ring).middle(), *place));
  }
  const double middle = longitudesOf(all).middle();
  diagram.centroid[cell].x += turnsTo(diagram.centroid[cell].x, middle);
  if (!diagram.mass_centroid.empty()) {
    diagram.mass_centroid[cell].x += turnsTo(diagram.mass_centroid[cell].x, middle);
  }
}

}  // namespace

Result<void> checkPlaces(const Sites& degrees) {
  if (degrees.size() == 0) return tl::unexpected(refusalOf(Subject::sites, "there are none"));
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const Point place{degrees.x[i], degrees.y[i]};
    if (!isPlace(place)) return noPlace(Subject::sites, fmt::format("site {}", i), place);
  }
  return {};
}

Result<Projection> projectionAmid(const Sites& degrees) {
  VORPIPE_TRY(checkPlaces(degrees));
  SpaceBox box;
  for (std::size_t i = 0; i < degrees.size(); ++i) box.add({degrees.x[i], degrees.y[i]});
  return projectionNear(box.middle().value_or(Point{0, 0}));
}

Result<Projection> projectionAmid(const Outline& degrees) {
  if (degrees.empty()) return tl::unexpected(refusalOf(Subject::outline, "it has no points"));
  for (const Point place : degrees.points) {
    if (!isPlace(place)) return noPlace(Subject::outline, "the point", place);
  }
  SpaceBox box;
  for (const Point place : degrees.points) box.add(place);
  if (const auto middle = box.middle()) return projectionNear(*middle);
  return projectionNear(middleLeftOf(core::ringAt(degrees, 0)).value_or(Point{0, 0}));
}

Result<Sites> toPlane(const Projection& projection, const Sites& degrees, int threads) {
  VORPIPE_TRY(checkPlaces(degrees));
  Sites plane;
  plane.x.resize(degrees.size());
  plane.y.resize(degrees.size());
  plane.weight = degrees.weight;
  parallelEach(degrees.size(), places_grain, threadCount(threads), [&](std::size_t i) {
    const Point at = projection.toPlane({degrees.x[i], degrees.y[i]});
    plane.x[i] = at.x;
    plane.y[i] = at.y;
  });
  return plane;
}

Sites turned(const Projection& projection, Sites degrees) {
  // The meridian opposite to the center counts as east of it, as in toDegrees.
  for (double& x : degrees.x) x -= whole_turn * std::ceil((x - projection.center().x) / whole_turn - 0.5);
  return degrees;
}

void toDegrees(const Projection& projection, const Sites& degrees, Diagram& diagram, int threads) {
  const auto convert = [&](std::vector<Point>& points, const auto& convertOne) {
    parallelEach(points.size(), places_grain, threadCount(threads),
                 [&](std::size_t i) { points[i] = convertOne(i, points[i]); });
  };
  convert(diagram.vertices, [&](std::size_t, Point at) { return projection.toDegrees(at); });
  // Without a cell, these are the site itself.
  const auto ofSite = [&](std::size_t i, Point at) {
    return diagram.status[i] == Status::ok ? projection.toDegrees(at) : Point{degrees.x[i], degrees.y[i]};
  };
  convert(diagram.centroid, ofSite);
  convert(diagram.mass_centroid, ofSite);
  if (diagram.vertices.empty()) return;
  parallelEach(diagram.size(), places_grain, threadCount(threads),
               [&](std::size_t i) { joinTurns(degrees.x[i], i, diagram); });
}

void toDegrees(const Projection& projection, Topology& topology, int threads) {
  auto& vertices = topology.vertices;
  parallelEach(vertices.size(), places_grain, threadCount(threads),
               [&](std::size_t i) { vertices[i] = projection.toDegrees(vertices[i]); });
}

}  // namespace vorpipe
