#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "domain/degrees.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

// WGS 84.
constexpr double equator_radius = 6378.137;  ///< km
constexpr double flattening = 1 / 298.257223563;
constexpr double ellipticity = flattening * (2 - flattening);  ///< e^2

const double eccentricity = std::sqrt(ellipticity);
/// Snyder's q at the pole (3-12): the Earth has the area 2 pi a^2 q.
const double q_of_pole = 1 + (1 - ellipticity) / eccentricity * std::atanh(eccentricity);
/// Radius of the sphere of the same area (3-13).
const double radius = equator_radius * std::sqrt(q_of_pole / 2);

}  // namespace

// (3-11, 3-12). It computes the difference of q from its value at the pole, not q: near the pole a sine
// determines its angle poorly.
Latitude authalic(double latitude) {
  const double above = std::abs(latitude);
  double sine = std::sin(above * degree), lack = 1 - sine;  // 1 - sine, of the geodetic latitude
  if (above > quarter_turn / 2) {
    const double rest = (quarter_turn - above) * degree, half = std::sin(rest / 2);
    sine = std::cos(rest);
    lack = 2 * half * half;
  }
  const double lack_of_q =
      lack * (1 + ellipticity * sine) / (1 - ellipticity * sine * sine) +
      (1 - ellipticity) / eccentricity * std::atanh(eccentricity * lack / (1 - ellipticity * sine));
  const double rest = lack_of_q / q_of_pole;
  return {std::copysign(1 - rest, latitude), std::sqrt(rest * (2 - rest))};
}

// The series (3-18), corrected by the remaining error until done; each step leaves 1 / 200 of it.
double geodetic(double authalic_angle) {
  const auto angleOf = [](const Latitude& latitude) { return std::atan2(latitude.sine, latitude.cosine); };
  constexpr double e2 = ellipticity, e4 = e2 * e2, e6 = e4 * e2;
  double latitude =
      (authalic_angle + (e2 / 3 + 31 * e4 / 180 + 517 * e6 / 5040) * std::sin(2 * authalic_angle) +
       (23 * e4 / 360 + 251 * e6 / 3780) * std::sin(4 * authalic_angle) +
       (761 * e6 / 45360) * std::sin(6 * authalic_angle)) /
      degree;
  constexpr int steps = 3;
  for (int k = 0; k < steps; ++k) {
    latitude = std::clamp(latitude, -quarter_turn, quarter_turn);
    latitude += (authalic_angle - angleOf(authalic(latitude))) / degree;
  }
  return std::clamp(latitude, -quarter_turn, quarter_turn);
}

namespace {

/// The longitude in (-180, 180]: exact, and the same for every turn.
double inTurn(double longitude) {
  const double rest = std::remainder(longitude, whole_turn);
  return rest == -whole_turn / 2 ? whole_turn / 2 : rest;
}

}  // namespace

Result<Projection> Projection::around(Point degrees) {
  if (!(std::abs(degrees.x) <= whole_turn) || !(std::abs(degrees.y) <= quarter_turn)) {
    return tl::unexpected(Error{
        ErrorCode::input,
        fmt::format("the center {}, {} is no place on the Earth: a longitude is within {} degrees of 0, "
                    "a latitude within {}",
                    degrees.x, degrees.y, whole_turn, quarter_turn)});
  }
  Projection made;
  made.center_ = degrees;
  const Latitude center = authalic(degrees.y);
  made.sine_ = center.sine;
  made.cosine_ = center.cosine;
  if (center.cosine > 0) {
    const double sine = std::sin(degrees.y * degree);
    const double cosine = std::sin((quarter_turn - std::abs(degrees.y)) * degree);
    made.stretch_ = equator_radius * cosine /
                    (std::sqrt(1 - ellipticity * sine * sine) * radius * center.cosine);  // (24-20)
  }
  return made;
}

Point Projection::toPlane(Point degrees) const {
  const double east = std::remainder(inTurn(degrees.x) - inTurn(center_.x), whole_turn) * degree;
  const Latitude to = authalic(degrees.y);
  const double half = std::sin(east / 2), less = 2 * half * half;  // 1 - cos(east)
  double across = to.cosine * std::sin(east);
  double along = (cosine_ * to.sine - sine_ * to.cosine) + sine_ * to.cosine * less;
  const double denominator = 1 + sine_ * to.sine + cosine_ * to.cosine * std::cos(east);
  double scale = 0;
  if (denominator >= 1) {
    scale = std::sqrt(2 / denominator);  // (24-19)
  } else {
    // Far away, distance and direction are more accurate.
    const double sine = std::hypot(across, along);
    if (sine == 0) along = 1;
    scale = std::sqrt(2 * (2 - denominator)) / (sine == 0 ? 1 : sine);
  }
  across *= scale;
  along *= scale;
  return {radius * stretch_ * across, radius / stretch_ * along};  // (24-17), (24-18)
}

Point Projection::toDegrees(Point kilometers) const {
  constexpr double rounding = 1e-12, nothing = std::numeric_limits<double>::quiet_NaN();
  const double x = kilometers.x / (radius * stretch_), y = kilometers.y * stretch_ / radius;
  const double sine_of_half = (x * x + y * y) / 4;  // squared; of the angle from the center (24-28)
  if (!(sine_of_half <= 1 + rounding)) return {nothing, nothing};
  const double cosine_of_half = std::sqrt(std::max(1 - sine_of_half, 0.0));
  const double cosine = 1 - 2 * sine_of_half;
  const double across = x * cosine_of_half, along = cosine_ * cosine - y * cosine_of_half * sine_;
  const double sine_of_latitude = cosine * sine_ + y * cosine_of_half * cosine_;
  return {center_.x + std::atan2(across, along) / degree,
          geodetic(std::atan2(sine_of_latitude, std::hypot(across, along)))};
}

}  // namespace vorpipe
