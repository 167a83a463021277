/// A float that is as wrong as Vulkan allows, in whatever way does most harm.
#pragma once

#include <cmath>
#include <cstdint>

#include "support/sites/random_sites.h"

namespace vorpipe::test {

/// How the arithmetic of a device errs. The precision table of Vulkan's SPIR-V environment: sums and products
/// are rounded correctly, but may be fused; a quotient is off by up to 2.5 units in the last place, an
/// inverse root by 2; a root is one divided by that.
struct Sloppiness {
  enum class Way : std::uint8_t { none, up, down, random };
  Way way = Way::random;
  Random random{1};

  /// Up to `units` in the last place off what is right, for the most part as far as that.
  float off(double right, double units);
  /// Whether this product and sum become one.
  bool fuses() { return way != Way::none && random.below(2) == 0; }
};

/// Of this thread.
Sloppiness& sloppiness();

class Sloppy {
 public:
  Sloppy() = default;
  // As in GLSL, numbers become this type by themselves.
  Sloppy(float value) : value_(value), exact_(static_cast<double>(value)) {}  // NOLINT
  Sloppy(double value) : Sloppy(static_cast<float>(value)) {}                 // NOLINT
  Sloppy(int value) : Sloppy(static_cast<float>(value)) {}                    // NOLINT

  explicit operator int() const { return static_cast<int>(value_); }
  [[nodiscard]] float value() const { return value_; }

  friend Sloppy operator-(Sloppy a) { return Sloppy(-a.value_, -a.exact_); }
  friend Sloppy operator*(Sloppy a, Sloppy b) {
    const double exact = static_cast<double>(a.value_) * static_cast<double>(b.value_);
    return {static_cast<float>(exact), exact};
  }
  friend Sloppy operator/(Sloppy a, Sloppy b) {
    return sloppiness().off(static_cast<double>(a.value_) / static_cast<double>(b.value_), 2.5);
  }
  /// The exact sum of a product and a float is rounded to a double first, which is off by too little to
  /// count.
  friend Sloppy operator+(Sloppy a, Sloppy b) {
    if (a.isProduct() && sloppiness().fuses()) return {a.exact_ + static_cast<double>(b.value_)};
    if (b.isProduct() && sloppiness().fuses()) return {static_cast<double>(a.value_) + b.exact_};
    return {a.value_ + b.value_};
  }
  friend Sloppy operator-(Sloppy a, Sloppy b) { return a + -b; }
  Sloppy& operator+=(Sloppy b) { return *this = *this + b; }
  Sloppy& operator-=(Sloppy b) { return *this = *this - b; }
  Sloppy& operator*=(Sloppy b) { return *this = *this * b; }

  friend bool operator<(Sloppy a, Sloppy b) { return a.value_ < b.value_; }
  friend bool operator>(Sloppy a, Sloppy b) { return a.value_ > b.value_; }
  friend bool operator<=(Sloppy a, Sloppy b) { return a.value_ <= b.value_; }
  friend bool operator>=(Sloppy a, Sloppy b) { return a.value_ >= b.value_; }

  friend Sloppy sqrt(Sloppy a) {
    if (a.value_ <= 0) return {0.0F};
    const float inverse = sloppiness().off(1 / std::sqrt(static_cast<double>(a.value_)), 2);
    return {sloppiness().off(1 / static_cast<double>(inverse), 2.5)};
  }
  friend Sloppy abs(Sloppy a) { return a.value_ < 0 ? -a : a; }
  friend Sloppy max(Sloppy a, Sloppy b) { return a.value_ < b.value_ ? b : a; }
  friend Sloppy min(Sloppy a, Sloppy b) { return b.value_ < a.value_ ? b : a; }

 private:
  Sloppy(float value, double exact) : value_(value), exact_(exact) {}
  [[nodiscard]] bool isProduct() const { return static_cast<double>(value_) != exact_; }

  float value_;
  double exact_;  ///< of a product, before it was rounded
};

}  // namespace vorpipe::test
