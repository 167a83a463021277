// Places on the Earth: whether they are, amid which, and in the plane.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/refusal.h"
#include "vorpipe.h"

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

  /// Where the box's middle lies, seen from the center of the Earth; degrees.
  [[nodiscard]] Point middle() const {
    const double x = low_[0] + high_[0], y = low_[1] + high_[1], z = low_[2] + high_[2];
    const double across = std::hypot(x, y);
    // All around the Earth, or a pole, any direction is as good.
    constexpr double least = 1e-9;
    const bool around = across < least;
    return {around ? 0 : std::atan2(y, x) / degree,
            around && std::abs(z) < least ? 0 : std::atan2(z, across) / degree};
  }

 private:
  std::array<double, 3> low_ = {1, 1, 1}, high_ = {-1, -1, -1};
};

template <class PlaceAt>
Result<Projection> amid(std::size_t count, const PlaceAt& placeAt) {
  SpaceBox box;
  for (std::size_t i = 0; i < count; ++i) box.add(placeAt(i));
  constexpr double steps = 100;  // of a degree
  const auto rounded = [](double degrees) { return std::round(degrees * steps) / steps + 0.0; };
  const Point middle = box.middle();
  return Projection::around({rounded(middle.x), rounded(middle.y)});
}

/// Refuses a site that is no place.
Result<void> checkPlaces(const Sites& degrees) {
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const Point place{degrees.x[i], degrees.y[i]};
    if (!isPlace(place)) return noPlace(Subject::sites, fmt::format("site {}", i), place);
  }
  return {};
}

}  // namespace

Result<Projection> projectionAmid(const Sites& degrees) {
  if (degrees.size() == 0) return tl::unexpected(refusalOf(Subject::sites, "there are none"));
  if (auto checked = checkPlaces(degrees); !checked) return tl::unexpected(std::move(checked.error()));
  return amid(degrees.size(), [&](std::size_t i) { return Point{degrees.x[i], degrees.y[i]}; });
}

Result<Projection> projectionAmid(const Outline& degrees) {
  if (degrees.empty()) return tl::unexpected(refusalOf(Subject::outline, "it has no points"));
  for (const Point place : degrees.points) {
    if (!isPlace(place)) return noPlace(Subject::outline, "the point", place);
  }
  return amid(degrees.points.size(), [&](std::size_t i) { return degrees.points[i]; });
}

Result<Sites> toPlane(const Projection& projection, const Sites& degrees, int threads) {
  if (auto checked = checkPlaces(degrees); !checked) return tl::unexpected(std::move(checked.error()));
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

void toDegrees(const Projection& projection, const Sites& degrees, Diagram& diagram, int threads) {
  const auto convert = [&](std::vector<Point>& points, const auto& convertOne) {
    parallelFor(points.size(), grain, threadCount(threads), [&](std::size_t begin, std::size_t end) {
      for (auto i = begin; i < end; ++i) points[i] = convertOne(i, points[i]);
    });
  };
  convert(diagram.vertices, [&](std::size_t, Point at) { return projection.toDegrees(at); });
  // Where there is no cell these are the site itself.
  const auto ofSite = [&](std::size_t i, Point at) {
    return diagram.status[i] == Status::ok ? projection.toDegrees(at) : Point{degrees.x[i], degrees.y[i]};
  };
  convert(diagram.centroid, ofSite);
  convert(diagram.mass_centroid, ofSite);
}

}  // namespace vorpipe
