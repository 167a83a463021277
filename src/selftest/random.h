/// Random numbers that are the same on every platform.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace vorpipe::selftests {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// From 0 to `below`, which it never is.
  std::uint64_t whole(std::uint64_t below) { return engine_() % below; }

  /// In [low, high).
  double between(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
  }

  /// A place of a lattice with so many in a row, from 0 on; every second one is moved by up to `noise`.
  double nearLattice(std::uint64_t side, double spacing, double noise) {
    const double place = spacing * static_cast<double>(whole(side));
    return whole(2) == 0 ? place : place + noise * between(0, 1);
  }

  /// 10 to the power of something between low and high.
  double power(double low, double high) { return std::pow(10.0, between(low, high)); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace vorpipe::selftests
