#include "globe/arc_batch.h"

#include <cmath>

#include "base/processors.h"
#include "globe/ellipsoid.h"

namespace vorpipe::core {
namespace {

/// Up to this tangent a series has an angle to the last bit.
constexpr double short_series = 0.01;

inline bool isShort(double y, double x) { return std::abs(y) < short_series * x; }

/// The angle whose sine and cosine are as y to x, if it is short.
[[gnu::always_inline]] inline double shortAngleOf(double y, double x) {
  const double tangent = y / x, squared = tangent * tangent;
  return tangent * (1 - squared * (1.0 / 3 - squared * (1.0 / 5 - squared * (1.0 / 7))));
}

double angleOf(double y, double x) { return isShort(y, x) ? shortAngleOf(y, x) : std::atan2(y, x); }

/// cos(p t) / cos(t) and sin(p t) / (p sin(t)), less 1, as series in t^2 (1 - p^2), up to t = `short_half`.
class PointOfHalf {
 public:
  static constexpr double short_half = 0.02;

  constexpr explicit PointOfHalf(double part) : part_(part) {
    const double p = part * part, q = p * p;
    even_ = {1.0 / 2, (5 - p) / 24, (61 - 14 * p + q) / 720, (1385 - (323 - (27 - p) * p) * p) / 40320};
    odd_ = {1.0 / 6, (7 - 3 * p) / 360, (31 - 18 * p + 3 * q) / 15120,
            (381 - (239 - (55 - 5 * p) * p) * p) / 1814400};
  }

  struct Shares {
    double of_middle, of_half;
  };
  /// The place of an arc at this part of its half angle, by its chord's middle and half.
  [[nodiscard]] Shares at(double half_angle) const {
    const double angle = part_ * half_angle;
    return {std::cos(angle) / std::cos(half_angle), std::sin(angle) / std::sin(half_angle)};
  }
  /// The same below `short_half`.
  [[nodiscard, gnu::always_inline]] inline Shares atShort(double half_angle) const {
    const double squared = half_angle * half_angle, lack = (1 - part_ * part_) * squared;
    return {1 + lack * sumOf(even_, squared), part_ * (1 + lack * sumOf(odd_, squared))};
  }

 private:
  [[gnu::always_inline]] static double sumOf(const std::array<double, 4>& series, double squared) {
    return series[0] + squared * (series[1] + squared * (series[2] + squared * series[3]));
  }

  double part_;
  std::array<double, 4> even_{}, odd_{};
};

/// Heights along an arc, by its half angle: `of_middle` of the middle between its ends, plus or less
/// `of_half` of half their difference.
class ArcHeights {
 public:
  ArcHeights(double from, double to) : middle_(0.5 * (from + to)), half_(0.5 * (to - from)) {}

  // Gauss's rules of two, three and four points have the mean of the difference along an arc. The fourth
  // power of the first, by 270, is rounding, and the sixth of the second, by 31500.
  static constexpr double for_two = 2e-3, for_three = PointOfHalf::short_half;

  [[nodiscard, gnu::always_inline]] inline double meanOfTwo(double half_angle) const {
    constexpr PointOfHalf inner(0.57735026918962576);
    return atBoth(inner.atShort(half_angle)) / 2;
  }
  [[nodiscard, gnu::always_inline]] inline double meanOfThree(double half_angle) const {
    constexpr PointOfHalf center(0), outer(0.77459666924148338);
    return (8 * ellipsoidExcess(center.atShort(half_angle).of_middle * middle_) +
            5 * atBoth(outer.atShort(half_angle))) /
           18;
  }
  [[nodiscard]] double meanOfFour(double half_angle) const {
    constexpr PointOfHalf inner(0.33998104358485626), outer(0.86113631159405258);
    return (0.65214515486254614 * atBoth(inner.at(half_angle)) +
            0.34785484513745386 * atBoth(outer.at(half_angle))) /
           2;
  }
  [[nodiscard]] double mean(double half_angle) const {
    return half_angle < for_two     ? meanOfTwo(half_angle)
           : half_angle < for_three ? meanOfThree(half_angle)
                                    : meanOfFour(half_angle);
  }

 private:
  [[nodiscard, gnu::always_inline]] inline double atBoth(const PointOfHalf::Shares& at) const {
    const auto [even, odd] = at;
    return ellipsoidExcess(even * middle_ + odd * half_) + ellipsoidExcess(even * middle_ - odd * half_);
  }

  double middle_, half_;
};

/// The sine of an angle and its cosine, or as much of both.
struct AngleParts {
  double y, x;
};

/// Half the solid angle of an arc and a cell's apex (Van Oosterom and Strackee 1983).
[[gnu::always_inline]] inline AngleParts halfSolidOf(const Direction& apex, const Direction& from,
                                                     const Direction& to) {
  return {dot(apex, cross(from - apex, to - apex)), 1 + dot(apex, from) + dot(from, to) + dot(to, apex)};
}

/// An arc's share in the center of its cell: `longer` is its angle over the sine, 0 where that is.
[[gnu::always_inline]] inline Direction centerShare(const Direction& apex, const Direction& from,
                                                    const Direction& to, double solid, double longer,
                                                    bool is_small) {
  const Direction flat = (from - apex) + (to - apex), turn = cross(from, to);
  const double by = is_small ? solid / 3 : longer / 2;
  return {by * (is_small ? flat.x : turn.x), by * (is_small ? flat.y : turn.y),
          by * (is_small ? flat.z : turn.z)};
}

}  // namespace

ArcShare shareOf(const Direction& apex, const Direction& from, const Direction& to, bool is_small) {
  const auto [y, x] = halfSolidOf(apex, from, to);
  const double solid = 2 * angleOf(y, x);
  const Direction turn = cross(from, to);
  const double sine = lengthOf(turn), angle = angleOf(sine, dot(from, to));
  const double longer = sine == 0 ? 0 : angle / sine;
  return {solid, angle, turn.z * longer * ArcHeights(from.z, to.z).mean(angle / 2),
          centerShare(apex, from, to, solid, longer, is_small)};
}

void ArcBatch::add(const Direction& apex, std::span<const Direction> vertices, bool is_small) {
  for (std::size_t e = 0; e < vertices.size(); ++e) {
    apex_.set(size_, apex);
    from_.set(size_, vertices[e]);
    to_.set(size_, vertices[e + 1 < vertices.size() ? e + 1 : 0]);
    small_[size_++] = is_small ? 1 : 0;
  }
}

// Loops run over the whole capacity, used or not: with a trip count that the compiler knows it makes vectors
// of all steps, and no scalar loop for a remainder.

FOR_WIDE_TOO void ArcBatch::findAngles() {
  for (std::size_t k = 0; k < room; ++k) {
    const Direction from = from_.at(k), to = to_.at(k);
    const auto [y, x] = halfSolidOf(apex_.at(k), from, to);
    const Direction turn = cross(from, to);
    const double sine = std::sqrt(dot(turn, turn)), cosine = dot(from, to);
    height_[k] = y, base_[k] = x, sine_[k] = sine, cosine_[k] = cosine;
    solid_[k] = 2 * shortAngleOf(y, x);
    angle_[k] = shortAngleOf(sine, cosine);
  }
}

FOR_WIDE_TOO void ArcBatch::findShares() {
  for (std::size_t k = 0; k < room; ++k) {
    const Direction from = from_.at(k), to = to_.at(k);
    const double sine = sine_[k], angle = angle_[k], half_angle = angle / 2;
    const double longer = sine == 0 ? 0 : angle / sine;
    const ArcHeights heights(from.z, to.z);
    const double two = heights.meanOfTwo(half_angle), three = heights.meanOfThree(half_angle);
    const double mean = half_angle < ArcHeights::for_two ? two : three;
    ellipsoid_[k] = (from.x * to.y - from.y * to.x) * longer * mean;
    const Direction center = centerShare(apex_.at(k), from, to, solid_[k], longer, small_[k] != 0);
    center_.x[k] = center.x, center_.y[k] = center.y, center_.z[k] = center.z;
  }
}

void ArcBatch::findLongAngles() {
  for (std::size_t k = 0; k < size_; ++k) {
    if (!isShort(height_[k], base_[k])) solid_[k] = 2 * std::atan2(height_[k], base_[k]);
    if (!isShort(sine_[k], cosine_[k])) angle_[k] = std::atan2(sine_[k], cosine_[k]);
  }
}

void ArcBatch::findLongShares() {
  for (std::size_t k = 0; k < size_; ++k) {
    if (angle_[k] / 2 < ArcHeights::for_three) continue;
    ellipsoid_[k] = shareOf(apex_.at(k), from_.at(k), to_.at(k), small_[k] != 0).ellipsoid;
  }
}

void ArcBatch::measure() {
  findAngles();
  findLongAngles();
  findShares();
  findLongShares();
}

}  // namespace vorpipe::core
