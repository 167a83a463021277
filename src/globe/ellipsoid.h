/// The Earth's ellipsoid, and what it has more than the sphere of its area.
#pragma once

#include <array>
#include <cstddef>

namespace vorpipe::core {

inline constexpr double equator_radius = 6378.137;  // km, of WGS 84
/// The square of its ellipse's eccentricity.
inline constexpr double ellipticity = 1 / 298.257223563 * (2 - 1 / 298.257223563);

inline constexpr std::size_t authalic_terms = 8;

/// The factors of (sin^2 latitude)^k in Snyder's q (3-12), by the sine: sine * (1 - e^2) * sum of
/// e^2k (2k + 2) / (2k + 1) (sin^2)^k.
constexpr std::array<double, authalic_terms> authalicSeries() {
  std::array<double, authalic_terms> factors{};
  double power = 1;
  for (std::size_t k = 0; k < authalic_terms; ++k) {
    factors[k] = power * static_cast<double>(2 * k + 2) / static_cast<double>(2 * k + 1);
    power *= ellipticity;
  }
  return factors;
}

constexpr double authalicSum(const std::array<double, authalic_terms>& factors) {
  double sum = 0;
  for (const double factor : factors) sum += factor;
  return sum;
}

/// The sine of the authalic latitude is s + s (1 - s^2) g(s^2), where s is that of the geodetic one: these
/// are the factors of the polynomial g.
constexpr std::array<double, authalic_terms - 1> excessSeries() {
  const auto series = authalicSeries();
  std::array<double, authalic_terms - 1> factors{};
  double rest = 0;
  for (std::size_t j = authalic_terms - 1; j-- > 0;) {
    rest += series[j + 1];
    factors[j] = -rest / authalicSum(series);
  }
  return factors;
}

/// Of the sphere that has the ellipsoid's area.
constexpr double squaredEarthRadius() {
  return equator_radius * equator_radius * (1 - ellipticity) * authalicSum(authalicSeries()) / 2;
}

/// What the ellipsoid has more than the sphere, at sine s, by z (x dy - y dx) along the border (Green).
[[gnu::always_inline]] inline double ellipsoidExcess(double s) {
  constexpr auto factors = excessSeries();
  const double squared = s * s;
  double sum = 0;
  for (std::size_t j = factors.size(); j-- > 0;) sum = sum * squared + factors[j];
  return -s * sum;
}

}  // namespace vorpipe::core
