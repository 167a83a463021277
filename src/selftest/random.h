/// Random numbers that are the same on every platform.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace vorpipe::selftests {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// A whole number from 0 to `below` - 1.
  std::uint64_t whole(std::uint64_t below) { return engine_() % below; }

  /// A number in [low, high).
  double between(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
  }

  /// A coordinate of one of `side` lattice points that begin at 0 with a distance of `spacing`. About half of
  /// them are moved by up to `noise`.
  double nearLattice(std::uint64_t side, double spacing, double noise) {
    const double exact = spacing * static_cast<double>(whole(side));
    return whole(2) == 0 ? exact : exact + noise * between(0, 1);
  }

  /// 10 to a power between `low` and `high`.
  double power(double low, double high) { return std::pow(10.0, between(low, high)); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace vorpipe::selftests
