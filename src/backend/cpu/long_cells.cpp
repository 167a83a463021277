#include "backend/cpu/long_cells.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cstdint>
#include <optional>
#include <utility>

#include "backend/cpu/glsl.h"
#include "backend/cpu/tree_cells.h"

namespace vorpipe::cpu {

/// Numbers of several hundred bits, with exponents that hold products of any doubles. No operation is
/// inlined: each takes longer than a call, and inlining makes the compiler four times slower.
template <unsigned Bits>
class LongReal {
 public:
  LongReal() = default;
  [[gnu::noinline]] LongReal(const LongReal& other) : value_(other.value_) {}
  [[gnu::noinline]] LongReal& operator=(const LongReal& other) {
    value_ = other.value_;
    return *this;
  }
  ~LongReal() = default;
  [[gnu::noinline]] explicit LongReal(double value) : value_(value) {}
  [[gnu::noinline]] explicit operator double() const { return static_cast<double>(value_); }

  static LongReal power(int exponent) { return LongReal(ldexp(Value(1.0), exponent)); }

  [[gnu::noinline]] LongReal operator-() const { return LongReal(-value_); }

  [[gnu::noinline]] friend LongReal operator+(const LongReal& a, const LongReal& b) {
    return LongReal(a.value_ + b.value_);
  }
  [[gnu::noinline]] friend LongReal operator-(const LongReal& a, const LongReal& b) {
    return LongReal(a.value_ - b.value_);
  }
  [[gnu::noinline]] friend LongReal operator*(const LongReal& a, const LongReal& b) {
    return LongReal(a.value_ * b.value_);
  }
  [[gnu::noinline]] friend LongReal operator/(const LongReal& a, const LongReal& b) {
    return LongReal(a.value_ / b.value_);
  }
  [[gnu::noinline]] friend LongReal sqrt(const LongReal& a) { return LongReal(sqrt(a.value_)); }
  [[gnu::noinline]] friend LongReal abs(const LongReal& a) { return LongReal(abs(a.value_)); }

  [[gnu::noinline]] friend bool operator<(const LongReal& a, const LongReal& b) {
    return a.value_ < b.value_;
  }
  [[gnu::noinline]] friend bool operator<=(const LongReal& a, const LongReal& b) {
    return a.value_ <= b.value_;
  }
  [[gnu::noinline]] friend bool operator==(const LongReal& a, const LongReal& b) {
    return a.value_ == b.value_;
  }
  friend bool operator>(const LongReal& a, const LongReal& b) { return b < a; }
  friend bool operator>=(const LongReal& a, const LongReal& b) { return b <= a; }

 private:
  using Value = boost::multiprecision::number<
      boost::multiprecision::cpp_bin_float<Bits, boost::multiprecision::digit_base_2, void, std::int32_t,
                                           -(1 << 20), (1 << 20)>,
      boost::multiprecision::et_off>;

  explicit LongReal(Value value) : value_(std::move(value)) {}

  Value value_;
};

template <unsigned Bits>
struct Number<LongReal<Bits>> {
  using Real = LongReal<Bits>;
  static const Real& rounding() {
    static const Real value = Real::power(-static_cast<int>(Bits));
    return value;
  }
  static const Real& far() {
    static const Real value = Real::power(1 << 15);
    return value;
  }
  static const Real& nowhere() {
    static const Real value = Real::power(-(1 << 17));
    return value;
  }
  static const Real& same() {
    static const Real value = Real::power(-(1 << 16));
    return value;
  }
};

/// The second is made once the first leaves a cell open.
struct LongFinder::Finders {
  const SiteSet& sites;
  const SiteTree& tree;
  CellFinder<LongReal<320>> usual{sites, tree};
  std::optional<CellFinder<LongReal<1280>>> longest{};
};

LongFinder::LongFinder(const SiteSet& sites, const SiteTree& tree) : finders_(new Finders{sites, tree}) {}

LongFinder::~LongFinder() = default;

CellStatus LongFinder::find(std::uint32_t site, std::vector<std::int32_t>& neighbors) {
  const auto status = finders_->usual.find(site, neighbors, false);
  if (status != CellStatus::open) return status;
  if (!finders_->longest) finders_->longest.emplace(finders_->sites, finders_->tree);
  return finders_->longest->find(site, neighbors, true);
}

}  // namespace vorpipe::cpu
