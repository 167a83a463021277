/// Conjugate gradients for numbers, or for vectors with one number or two by site.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block_sums.h"
#include "vorpipe.h"

namespace vorpipe::moving {

inline double product(double a, double b) { return a * b; }
inline double product(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline double shifted(double from, double times, double by) { return from + times * by; }
inline Point shifted(Point from, double times, Point by) {
  return {from.x + times * by.x, from.y + times * by.y};
}

template <class Value>
double dot(std::span<const Value> a, std::span<const Value> b, int threads) {
  return carefulSum(a.size(), threads, [&](std::size_t i) { return product(a[i], b[i]); });
}
template <class Value>
double dot(const std::vector<Value>& a, const std::vector<Value>& b, int threads) {
  return dot(std::span(a), std::span(b), threads);
}

/// Adds to x until the norm of `rest`, which is b - A x and follows it, is `least` or less. `multiply(way,
/// answer)` sets A times a vector, and `scale(rest, i)` returns an element of the preconditioned rest. Ends
/// also when rounding allows no more progress, or when `continues`, called before each iteration, returns
/// false. Returns the number of iterations.
template <class Value, class Multiply, class Scale, class Continues>
std::uint64_t conjugateGradients(std::vector<Value>& x, std::vector<Value>& rest, double least, int threads,
                                 const Multiply& multiply, const Scale& scale, const Continues& continues) {
  constexpr std::uint64_t most_iterations = 10000;
  const std::size_t count = x.size();
  std::vector<Value> scaled(count), answer;
  const auto precondition = [&] {
    forAll(count, threads, [&](std::size_t i) { scaled[i] = scale(rest[i], i); });
    return dot(rest, scaled, threads);
  };
  double due = precondition();
  std::vector<Value> way = scaled;
  std::uint64_t iteration = 0;
  for (; iteration < most_iterations && continues() && dot(rest, rest, threads) > least * least;
       ++iteration) {
    multiply(way, answer);
    const double curvature = dot(way, answer, threads);
    if (!(curvature > 0)) break;
    const double length = due / curvature;
    forAll(count, threads, [&](std::size_t i) {
      x[i] = shifted(x[i], length, way[i]);
      rest[i] = shifted(rest[i], -length, answer[i]);
    });
    const double next = precondition();
    const double turn = next / due;
    due = next;
    forAll(count, threads, [&](std::size_t i) { way[i] = shifted(scaled[i], turn, way[i]); });
  }
  return iteration;
}

}  // namespace vorpipe::moving
