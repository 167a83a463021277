#include "globe/direction.h"

#include "base/parallel.h"
#include "domain/degrees.h"
#include "sites/weights.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t direction_grain = 1024;

struct SineCosine {
  double sine, cosine;
};

SineCosine sineCosineOf(double degrees) {
  int quarter = 0;
  const double rest = std::remquo(degrees, quarter_turn, &quarter) * degree;
  const double sine = std::sin(rest), cosine = std::cos(rest);
  switch (quarter & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace

Direction perpendicular(const Direction& a) {
  const double x = std::abs(a.x), y = std::abs(a.y), z = std::abs(a.z);
  const Direction least = x <= y && x <= z ? Direction{1, 0, 0}
                          : y <= z         ? Direction{0, 1, 0}
                                           : Direction{0, 0, 1};
  return normalized(cross(least, a));
}

Direction directionOf(Point degrees) {
  const auto longitude = sineCosineOf(degrees.x), latitude = sineCosineOf(degrees.y);
  // Adding 0 turns -0 into 0.
  return {latitude.cosine * longitude.cosine + 0.0, latitude.cosine * longitude.sine + 0.0,
          latitude.sine + 0.0};
}

double excessOf(double weight) {
  const double radius = std::sqrt(std::abs(weight)) / earthRadius();
  if (weight < 0) {
    const double sine = std::sinh(radius / 2);
    return -2 * sine * sine / std::cosh(radius);
  }
  const double sine = std::sin(radius / 2);
  return 2 * sine * sine / std::cos(radius);
}

SphereSites placedOn(const Sites& sites, int threads) {
  const auto count = sites.size();
  SphereSites placed;
  placed.direction.resize(count);
  const bool has_weights = hasWeights(sites);
  if (has_weights) placed.excess.resize(count), placed.scaled.resize(count);
  parallelFor(count, direction_grain, threadsForSteps(count, threads),
              [&](std::size_t begin, std::size_t end) {
                for (auto i = begin; i < end; ++i) {
                  placed.direction[i] = directionOf({sites.x[i], sites.y[i]});
                  if (!has_weights) continue;
                  placed.excess[i] = excessOf(sites.weight[i]);
                  placed.scaled[i] = (1 + placed.excess[i]) * placed.direction[i];
                }
              });
  return placed;
}

Direction vectorOf(const Sites& sites, std::size_t site) {
  const Direction direction = directionOf({sites.x[site], sites.y[site]});
  return sites.weight.empty() ? direction : (1 + excessOf(sites.weight[site])) * direction;
}

Point placeOf(const Direction& direction) {
  const double across = std::hypot(direction.x, direction.y);
  if (across == 0) return {0, std::copysign(quarter_turn, direction.z)};
  return {std::atan2(direction.y + 0.0, direction.x) / degree, std::atan2(direction.z, across) / degree};
}

}  // namespace vorpipe::core
