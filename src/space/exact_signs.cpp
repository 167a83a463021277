#include "space/exact_signs.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/double_double.h"
#include "space/broken_tie.h"
#include "space/fixed_integer.h"
#include "space/relative.h"

namespace vorpipe::space {
namespace {

/// Without expression templates, whose references would outlive what functions return.
using AnyInteger =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;

/// The kinds of integers that determinants are computed in. Coordinates are less than 2^bits, so that a 2x2
/// minor is less than 2^(2 bits + 1), a 3x3 determinant than 2^(3 bits + 2.6), a lift than 2^(2 bits + 1.6),
/// and a 4x4 determinant than 2^(5 bits + 6.2). Differences of weights, which are added to lifts, are less
/// than 2^weight_bits: then a lift is less than 2^(2 bits + 2.4), and that determinant than 2^(5 bits + 7).
struct LongIntegers {
  static constexpr int bits = 62, weight_bits = 125;
  using Coordinate = std::int64_t;
  using Pair = Int128;
  using Triple = FixedInteger<3>;
  using Whole = FixedInteger<5>;
  static Triple times(Pair a, Coordinate b) { return product(a, b); }
  static Whole times(const Triple& a, Pair b) { return product(a, b); }
};

struct AnyIntegers {
  using Coordinate = AnyInteger;
  using Pair = AnyInteger;
  using Triple = AnyInteger;
  using Whole = AnyInteger;
  static AnyInteger times(const AnyInteger& a, const AnyInteger& b) { return a * b; }
};

/// Places relative to a site, exactly: of a site three numbers, of a wall its distance.
template <std::size_t size>
struct ExactTuple {
  std::array<Label, size> label;
  std::array<std::array<DoubleDouble, 3>, size> number;

  ExactTuple(const Places& places, Label site, const std::array<Label, size>& labels) : label(labels) {
    const Point3& from = places.sites[site];
    for (std::size_t k = 0; k < size; ++k) {
      if (isWallLabel(label[k])) {
        const int axis = axisOf(wallOf(label[k]));
        const auto distance = DoubleDouble::sum(wallOffset(places, label[k]), -coordinate(from, axis));
        number[k][0] = isUpper(wallOf(label[k])) ? distance : -distance;
      } else {
        const Point3& to = places.sites[label[k]];
        number[k] = {DoubleDouble::sum(to.x, -from.x), DoubleDouble::sum(to.y, -from.y),
                     DoubleDouble::sum(to.z, -from.z)};
      }
    }
  }
};

/// What labels are lighter by than a site, exactly; walls by nothing.
template <std::size_t size>
struct ExactWeights {
  std::array<DoubleDouble, size> lighter{};
  bool differ = false;

  ExactWeights(const Places& places, Label site, const std::array<Label, size>& label) {
    for (std::size_t k = 0; k < size && places.weights != nullptr; ++k) {
      if (isWallLabel(label[k])) continue;
      lighter[k] = DoubleDouble::sum(places.weights[site], -places.weights[label[k]]);
      differ = differ || lighter[k].high != 0;
    }
  }
};

template <class Integers>
struct WholeRow {
  typename Integers::Coordinate x{}, y{}, z{};
  typename Integers::Pair lift{};

  void set(Label label, const std::array<typename Integers::Coordinate, 3>& number) {
    using Pair = typename Integers::Pair;
    if (isWallLabel(label)) {
      const int axis = axisOf(wallOf(label)), out = isUpper(wallOf(label)) ? 1 : -1;
      x = axis == 0 ? out : 0;
      y = axis == 1 ? out : 0;
      z = axis == 2 ? out : 0;
      lift = Pair(number[0]) * 2;
    } else {
      x = number[0];
      y = number[1];
      z = number[2];
      lift = Pair(x) * x + Pair(y) * y + Pair(z) * z;
    }
  }
};

template <class Integers>
typename Integers::Pair minorOf(const WholeRow<Integers>& a, const WholeRow<Integers>& b) {
  using Pair = typename Integers::Pair;
  return Pair(a.x) * b.y - Pair(a.y) * b.x;
}

/// The determinant of three d: a (b x c) - b (a x c) + c (a x b), from minors in x and y. Called, it
/// would write long integers to memory in other parts than it reads them in, for which processors wait: three
/// times as slow.
template <class Integers, class Pair>
[[gnu::always_inline]] inline auto determinant(const WholeRow<Integers>& a, const Pair& bc,
                                               const WholeRow<Integers>& b, const Pair& ac,
                                               const WholeRow<Integers>& c, const Pair& ab) {
  return Integers::times(bc, a.z) - Integers::times(ac, b.z) + Integers::times(ab, c.z);
}

/// Its logarithm to base 2, rounded down; -1023 if it is less than 2^-1022.
int exponentOf(double positive) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(positive) >> 52U) - 1023;
}

double powerOfTwo(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52U);
}

/// Numbers as multiples of one power of two, if each fits.
class Units {
 public:
  template <std::size_t size>
  explicit Units(const ExactTuple<size>& tuple) {
    double largest = 0;
    for (const auto& place : tuple.number) {
      for (const auto& number : place) largest = std::max(largest, std::abs(number.high));
    }
    // So that any number with its rounding error is less than 2^62. Beyond, the unit's inverse is no double.
    const int exponent = std::max(exponentOf(largest), -900);
    exponent_ = exponent - 61;
    unit_ = powerOfTwo(exponent_);
    per_unit_ = powerOfTwo(-exponent_);
  }

  /// The number; if it is no multiple of the unit, fit() is false from then on.
  std::int64_t whole(const DoubleDouble& number) {
    std::int64_t sum = part(number.high);
    if (number.low != 0) sum += part(number.low);
    return sum;
  }

  [[nodiscard]] bool fit() const { return fit_; }
  /// The unit's.
  [[nodiscard]] int exponent() const { return exponent_; }

 private:
  std::int64_t part(double number) {
    const auto units = static_cast<std::int64_t>(number * per_unit_);
    fit_ = fit_ && static_cast<double>(units) * unit_ == number;
    return units;
  }

  double unit_, per_unit_;
  int exponent_;
  bool fit_ = true;
};

/// Differences of weights as multiples of the square of 2^unit, if each fits.
template <std::size_t size>
class WeightUnits {
 public:
  WeightUnits(const ExactWeights<size>& weights, int unit) {
    if (!weights.differ) return;
    // Beyond, the unit's square is no double.
    fit_ = std::abs(unit) < 400;
    if (!fit_) return;
    const double square = powerOfTwo(2 * unit), per_square = powerOfTwo(-2 * unit);
    for (std::size_t k = 0; k < size; ++k) {
      for (const double part : {weights.lighter[k].high, weights.lighter[k].low}) {
        const double units = part * per_square;
        fit_ = fit_ && std::abs(units) < 0x1p124;
        if (!fit_) return;
        const auto whole = static_cast<Int128>(units);
        fit_ = static_cast<double>(whole) * square == part;
        number_[k] += whole;
      }
    }
    static_assert(LongIntegers::weight_bits == 125);
  }

  [[nodiscard]] bool fit() const { return fit_; }
  [[nodiscard]] Int128 operator()(std::size_t k) const { return number_[k]; }

 private:
  bool fit_ = true;
  std::array<Int128, size> number_{};
};

/// The same as withRows, with weights: lighter(k) in the square of the numbers' unit.
template <class Integers, std::size_t size, class Numbers, class Lighter, class Use>
int withWeightedRows(const std::array<Label, size>& label, const Numbers& number, const Lighter& lighter,
                     const Use& use) {
  std::array<WholeRow<Integers>, size> row;
  for (std::size_t k = 0; k < size; ++k) {
    row[k].set(label[k], number[k]);
    row[k].lift += lighter(k);
  }
  return use(row);
}

template <class Integers, std::size_t size, class Numbers, class Use>
int withRows(const std::array<Label, size>& label, const Numbers& number, const Use& use) {
  std::array<WholeRow<Integers>, size> row;
  for (std::size_t k = 0; k < size; ++k) row[k].set(label[k], number[k]);
  return use(row);
}

/// Places relative to a site as multiples of 2^-60, which those of most runs are: coordinates are less
/// than 2.
template <std::size_t size>
struct FixedPlaces {
  static constexpr int exponent = -60;
  std::array<std::array<std::int64_t, 3>, size> number;

  FixedPlaces(const Places& places, Label site, const std::array<Label, size>& label) {
    const Point3& at = places.sites[site];
    const std::array<std::int64_t, 3> from{whole(at.x), whole(at.y), whole(at.z)};
    for (std::size_t k = 0; k < size; ++k) {
      if (isWallLabel(label[k])) {
        const int wall = wallOf(label[k]);
        const std::int64_t distance =
            whole(wallOffset(places, label[k])) - from[static_cast<std::size_t>(axisOf(wall))];
        number[k] = {isUpper(wall) ? distance : -distance, 0, 0};
      } else {
        const Point3& to = places.sites[label[k]];
        number[k] = {whole(to.x) - from[0], whole(to.y) - from[1], whole(to.z) - from[2]};
      }
    }
  }
  [[nodiscard]] bool fit() const { return fit_; }

 private:
  std::int64_t whole(double at) {
    constexpr double no_integer = 0.5;
    const double exact = std::abs(at) < 2 ? at * 0x1p60 : no_integer;
    const auto units = static_cast<std::int64_t>(exact);
    fit_ = fit_ && static_cast<double>(units) == exact;
    return units;
  }
  bool fit_ = true;
};

/// number / 2^least.
AnyInteger multipleOf(double number, int least) {
  if (number == 0) return 0;
  int exponent = 0;
  const auto digits = static_cast<std::int64_t>(std::ldexp(std::frexp(number, &exponent), 53));
  return AnyInteger(digits) << (exponent - 53 - least);
}

/// The exponent of a unit of all numbers.
template <std::size_t size>
int leastBit(const ExactTuple<size>& tuple) {
  int least = 2000;
  const auto takeIn = [&](double number) {
    if (number != 0) least = std::min(least, std::ilogb(number) - 52);
  };
  for (const auto& place : tuple.number) {
    for (const auto& number : place) {
      takeIn(number.high);
      takeIn(number.low);
    }
  }
  return least;
}

/// Less than half of the exponent of a unit of all weights.
template <std::size_t size>
int leastBit(const ExactWeights<size>& weights) {
  int least = 2000;
  for (const auto& lighter : weights.lighter) {
    for (const double part : {lighter.high, lighter.low}) {
      if (part != 0) least = std::min(least, (std::ilogb(part) - 52) / 2 - 1);
    }
  }
  return least;
}

template <std::size_t size, class Use>
int withAnyIntegers(const ExactTuple<size>& tuple, const ExactWeights<size>& weights, int least,
                    const Use& use) {
  const auto multiple = [](const DoubleDouble& of, int unit) {
    return AnyInteger(multipleOf(of.high, unit) + multipleOf(of.low, unit));
  };
  std::array<std::array<AnyInteger, 3>, size> number;
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t c = 0; c < 3; ++c) number[k][c] = multiple(tuple.number[k][c], least);
  }
  if (!weights.differ) return withRows<AnyIntegers>(tuple.label, number, use);
  return withWeightedRows<AnyIntegers>(
      tuple.label, number, [&](std::size_t k) { return multiple(weights.lighter[k], 2 * least); }, use);
}

/// Calls it with rows of the least integers that hold them.
template <std::size_t size, class Use>
int withIntegers(const Places& places, Label site, const std::array<Label, size>& labels, const Use& use) {
  static_assert(LongIntegers::bits == 62);
  const FixedPlaces<size> fixed(places, site, labels);
  const ExactWeights<size> weights(places, site, labels);
  if (fixed.fit() && !weights.differ) return withRows<LongIntegers>(labels, fixed.number, use);
  if (fixed.fit()) {
    const WeightUnits<size> lighter(weights, FixedPlaces<size>::exponent);
    if (lighter.fit()) return withWeightedRows<LongIntegers>(labels, fixed.number, lighter, use);
  }
  const ExactTuple<size> tuple(places, site, labels);
  Units units(tuple);
  std::array<std::array<std::int64_t, 3>, size> number{};
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t c = 0; c < 3; ++c) number[k][c] = units.whole(tuple.number[k][c]);
  }
  if (units.fit() && !weights.differ) return withRows<LongIntegers>(labels, number, use);
  const WeightUnits<size> lighter(weights, units.exponent());
  if (units.fit() && lighter.fit()) return withWeightedRows<LongIntegers>(labels, number, lighter, use);
  return withAnyIntegers(tuple, weights, std::min(leastBit(tuple), leastBit(weights)), use);
}

/// 2^exponent a / b, rounded twice: to 64 bits or 65, and to a double.
double quotient(const AnyInteger& a, const AnyInteger& b, int exponent) {
  if (a == 0) return 0;
  const AnyInteger dividend = abs(a), divisor = abs(b);
  const int shift = 64 + static_cast<int>(msb(divisor)) - static_cast<int>(msb(dividend));
  const AnyInteger digits = shift > 0 ? (dividend << shift) / divisor : dividend / (divisor << -shift);
  const double magnitude = std::ldexp(static_cast<double>(digits), exponent - shift);
  return a.sign() == b.sign() ? magnitude : -magnitude;
}

/// The same.
double quotient(const FixedInteger<4>& a, const FixedInteger<3>& b, int exponent) {
  if (a.sign() == 0) return 0;
  const FixedInteger<4> dividend = a.sign() < 0 ? -a : a;
  const FixedInteger<3> divisor = b.sign() < 0 ? -b : b;
  const int last = lastBit(dividend), divisors = lastBit(divisor);
  const AnyInteger digits(
      leadingQuotient(shiftedLeft(dividend, 255 - last), shiftedLeft(divisor, 191 - divisors)));
  const double magnitude = std::ldexp(static_cast<double>(digits), exponent - (64 + divisors - last));
  return a.sign() == b.sign() ? magnitude : -magnitude;
}

/// The place of a vertex, from its faces in units of 2^exponent. times(lift, minor) are products of those.
template <class Integers, class Times>
Point3 placeOf(const std::array<WholeRow<Integers>, 3>& row, int exponent, const Times& times) {
  using Whole = WholeRow<Integers>;
  const auto &a = row[0], &b = row[1], &c = row[2];  // Clang 14 captures no structured bindings
  const auto det = determinant(a, minorOf(b, c), b, minorOf(a, c), c, minorOf(a, b));
  const auto twice = det + det;
  const auto component = [&](auto first, auto second) {
    using Pair = typename Integers::Pair;
    const auto minor = [&](const Whole& p, const Whole& q) {
      return Pair(Pair(p.*first) * q.*second - Pair(p.*second) * q.*first);
    };
    return quotient(times(a.lift, minor(b, c)) + times(b.lift, minor(c, a)) + times(c.lift, minor(a, b)),
                    twice, exponent);
  };
  return {component(&Whole::y, &Whole::z), component(&Whole::z, &Whole::x), component(&Whole::x, &Whole::y)};
}

}  // namespace

int exactOrientation(const Places& places, Label i, const std::array<Label, 3>& other) {
  const Places without_weights{places.sites, places.box};
  return withIntegers(without_weights, i, other,
                      []<class Integers>(const std::array<WholeRow<Integers>, 3>& row) {
                        const auto& [a, b, c] = row;
                        return signOf(determinant(a, minorOf(b, c), b, minorOf(a, c), c, minorOf(a, b)));
                      });
}

/// At the vertex p = (sum of lift_e (d_f x d_g)) / (2 det) of three labels the lift of the fourth less 2 p .
/// d is the determinant of the four rows (d, lift), over that of the three d.
int exactSide(const Places& places, Label i, const std::array<Label, 4>& other) {
  const auto side = [&]<class Integers>(const std::array<WholeRow<Integers>, 4>& row) {
    const auto& [a, b, c, d] = row;
    const auto ab = minorOf(a, b), ac = minorOf(a, c), ad = minorOf(a, d);
    const auto bc = minorOf(b, c), bd = minorOf(b, d), cd = minorOf(c, d);
    const std::array<typename Integers::Triple, 4> cofactor{
        -determinant(b, cd, c, bd, d, bc), determinant(a, cd, c, ad, d, ac),
        -determinant(a, bd, b, ad, d, ab), determinant(a, bc, b, ac, c, ab)};
    typename Integers::Whole whole{};
    for (std::size_t k = 0; k < 4; ++k) whole += Integers::times(cofactor[k], row[k].lift);
    const int sign = signOf(whole);
    return signOf(cofactor[3]) * (sign != 0 ? sign : brokenTie(places, i, other, cofactor));
  };
  return withIntegers(places, i, other, side);
}

Point3 exactPlace(const Places& places, Label i, const std::array<Label, 3>& other) {
  const ExactTuple<3> tuple(places, i, other);
  Point3 place{};
  Units units(tuple);
  std::array<std::array<std::int64_t, 3>, 3> number{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t c = 0; c < 3; ++c) number[k][c] = units.whole(tuple.number[k][c]);
  }
  const ExactWeights<3> weights(places, i, other);
  const WeightUnits<3> lighter(weights, units.exponent());
  if (units.fit() && lighter.fit()) {
    const auto of_long = [&](const std::array<WholeRow<LongIntegers>, 3>& row) {
      // Sums of three products are less than 2^253.
      const auto times = [](Int128 a, Int128 b) {
        return product(FixedInteger<2>{{static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(a >> 64)}},
                       b);
      };
      place = placeOf(row, units.exponent(), times);
      return 0;
    };
    withWeightedRows<LongIntegers>(tuple.label, number, lighter, of_long);
    return place;
  }
  const int least = std::min(leastBit(tuple), leastBit(weights));
  withAnyIntegers(tuple, weights, least, [&](const std::array<WholeRow<AnyIntegers>, 3>& row) {
    place = placeOf(row, least, [](const AnyInteger& a, const AnyInteger& b) { return AnyInteger(a * b); });
    return 0;
  });
  return place;
}

}  // namespace vorpipe::space
