// Places on the Earth: whether they are, amid which, and in the plane.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/parallel.h"
#include "base/refusal.h"
#include "vorpipe.h"
#include "vorpipe/maps.h"

namespace vorpipe {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double quarter = 90, turn = 360;  ///< degrees
constexpr std::size_t grain = 1 << 12;

/// False for NaN.
bool isPlace(Point degrees) { return std::abs(degrees.x) <= turn && std::abs(degrees.y) <= quarter; }

tl::unexpected<Error> noPlace(Subject subject, const std::string& what, Point degrees) {
  return tl::unexpected(refusalOf(
      subject,
      fmt::format("{} at {}, {} is no place on the Earth: a longitude is within {} degrees of 0, a latitude "
                  "within {}",
                  what, degrees.x, degrees.y, turn, quarter)));
}

/// The box around places as points of the unit sphere.
class SpaceBox {
 public:
  void add(Point degrees) {
    const double x = degrees.x * degree, y = degrees.y * degree;
    const std::array<double, 3> at = {std::cos(y) * std::cos(x), std::cos(y) * std::sin(x), std::sin(y)};
    for (std::size_t k = 0; k < at.size(); ++k) {
      low_[k] = std::min(low_[k], at[k]);
      high_[k] = std::max(high_[k], at[k]);
    }
  }

  /// Where the box's middle lies, seen from the center of the Earth.
  [[nodiscard]] Point middle() const {
    constexpr double steps = 100;  // of a degree
    const auto rounded = [](double radians) { return std::round(radians / degree * steps) / steps + 0.0; };
    const double x = low_[0] + high_[0], y = low_[1] + high_[1], z = low_[2] + high_[2];
    const double across = std::hypot(x, y);
    // All around the Earth, or a pole, any direction is as good.
    constexpr double least = 1e-9;
    return {across < least ? 0 : rounded(std::atan2(y, x)),
            across < least && std::abs(z) < least ? 0 : rounded(std::atan2(z, across))};
  }

 private:
  std::array<double, 3> low_ = {1, 1, 1}, high_ = {-1, -1, -1};
};

}  // namespace

Result<Projection> projectionAmid(const Sites& degrees) {
  if (degrees.size() == 0) return tl::unexpected(refusalOf(Subject::sites, "there are none"));
  SpaceBox box;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const Point place{degrees.x[i], degrees.y[i]};
    if (!isPlace(place)) return noPlace(Subject::sites, fmt::format("site {}", i), place);
    box.add(place);
  }
  return Projection::around(box.middle());
}

Result<Projection> projectionAmid(const Outline& degrees) {
  if (degrees.empty()) return tl::unexpected(refusalOf(Subject::outline, "it has no points"));
  SpaceBox box;
  for (const Point place : degrees.points) {
    if (!isPlace(place)) return noPlace(Subject::outline, "the point", place);
    box.add(place);
  }
  return Projection::around(box.middle());
}

Result<Sites> toPlane(const Projection& projection, const Sites& degrees, int threads) {
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const Point place{degrees.x[i], degrees.y[i]};
    if (!isPlace(place)) return noPlace(Subject::sites, fmt::format("site {}", i), place);
  }
  Sites plane;
  plane.x.resize(degrees.size());
  plane.y.resize(degrees.size());
  plane.weight = degrees.weight;
  parallelFor(degrees.size(), grain, threadCount(threads), [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      const Point at = projection.toPlane({degrees.x[i], degrees.y[i]});
      plane.x[i] = at.x;
      plane.y[i] = at.y;
    }
  });
  return plane;
}

Sites turned(const Projection& projection, Sites degrees) {
  for (double& x : degrees.x) x -= turn * std::round((x - projection.center().x) / turn);
  return degrees;
}

void toDegrees(const Projection& projection, Diagram& diagram, int threads) {
  for (auto* const points : {&diagram.vertices, &diagram.centroid, &diagram.mass_centroid}) {
    parallelFor(points->size(), grain, threadCount(threads), [&](std::size_t begin, std::size_t end) {
      for (auto i = begin; i < end; ++i) (*points)[i] = projection.toDegrees((*points)[i]);
    });
  }
}

}  // namespace vorpipe
