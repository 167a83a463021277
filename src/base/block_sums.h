/// Sums over many terms, independent of the number of threads: blocks of one size are added in order.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/parallel.h"

namespace vorpipe {

/// Number of terms in a block.
inline constexpr std::size_t sum_block = 1024;

/// A sum that compensates for its rounding errors (Neumaier 1974).
class CarefulSum {
 public:
  void add(double term) {
    const double sum = sum_ + term;
    rest_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
    sum_ = sum;
  }
  /// Infinite if the sum exceeds the range of double.
  [[nodiscard]] double value() const { return std::isfinite(sum_) ? sum_ + rest_ : sum_; }

 private:
  double sum_ = 0, rest_ = 0;
};

/// Calls part(begin, end) for each block of [0, count), on several threads; returns its results in order.
template <class Value, class Part>
std::vector<Value> byBlocks(std::size_t count, int threads, const Part& part) {
  std::vector<Value> parts((count + sum_block - 1) / sum_block);
  parallelFor(count, sum_block, threadsForSteps(count, threads),
              [&](std::size_t begin, std::size_t end) { parts[begin / sum_block] = part(begin, end); });
  return parts;
}

/// Returns the sum of term(i) over [0, count), accurate to the last bits.
template <class Term>
double carefulSum(std::size_t count, int threads, const Term& term) {
  const auto parts = byBlocks<double>(count, threads, [&](std::size_t begin, std::size_t end) {
    CarefulSum sum;
    for (auto i = begin; i < end; ++i) sum.add(term(i));
    return sum.value();
  });
  CarefulSum sum;
  for (const double part : parts) sum.add(part);
  return sum.value();
}

/// Returns several sums at once: part(begin, end) returns those of a block.
template <std::size_t count, class Part>
std::array<double, count> sumsByBlocks(std::size_t size, int threads, const Part& part) {
  std::array<double, count> sums{};
  for (const auto& of_block : byBlocks<std::array<double, count>>(size, threads, part)) {
    for (std::size_t k = 0; k < count; ++k) sums[k] += of_block[k];
  }
  return sums;
}

/// Calls each(i) for all of [0, count), on several threads.
template <class Each>
void forAll(std::size_t count, int threads, const Each& each) {
  parallelFor(count, grainFor(count, std::size_t{1} << 14), threadsForSteps(count, threads),
              [&](std::size_t begin, std::size_t end) {
                for (auto i = begin; i < end; ++i) each(i);
              });
}

}  // namespace vorpipe
