/// Random numbers that are the same with every standard library, and sites put together from them.
#pragma once

#include <cstdint>
#include <random>

#include "vorpipe.h"

namespace vorpipe::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  std::uint64_t operator()() { return bits_(); }
  /// In [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  /// Less than n.
  std::uint64_t below(std::uint64_t n) { return bits_() % n; }
  /// Nearly normal, mean 0 and variance 1, within -6 and 6.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

 private:
  std::mt19937_64 bits_;
};

/// Call it with {x, y}: between braces, random numbers are drawn from left to right.
inline void add(Sites& sites, Point p) {
  sites.x.push_back(p.x);
  sites.y.push_back(p.y);
}

inline void append(Sites& sites, const Sites& more) {
  sites.x.insert(sites.x.end(), more.x.begin(), more.x.end());
  sites.y.insert(sites.y.end(), more.y.begin(), more.y.end());
}

}  // namespace vorpipe::test
