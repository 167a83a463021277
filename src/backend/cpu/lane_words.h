/// The vocabulary of shaders/glsl for several cells at once: `real`, `cell_int` and `cell_bool` are vectors
/// of VORPIPE_LANES numbers, one per cell. They are vector types of GCC and Clang with the operators of
/// numbers, including ?: with a vector of truths. Sums and products equal those of single floats, bit by bit.
///
/// For files that are compiled once for each instruction set. Everything is in an anonymous namespace and
/// uses no library templates. Otherwise the linker might choose a copy that another file compiled for
/// instructions this machine lacks.
#pragma once

#if VORPIPE_LANES == 16
#include <immintrin.h>
#endif

#include <cstddef>
#include <cstdint>

#define ANY(condition) anyOf(condition)
/// Not inlined, so that its loops have all registers: 7 % faster.
#define CUTTING [[gnu::noinline]]
#define UNROLL
#define EDGES(T, name) T name[static_cast<std::size_t>(MAX_EDGES)]
#define EDGE_END MAX_EDGES
#define IN(T) const T&
#define INOUT(T) T&

namespace vorpipe::cpu {
namespace {
namespace lanes {

constexpr int lane_count = VORPIPE_LANES;

using Reals [[gnu::vector_size(4 * lane_count)]] = float;
using Ints [[gnu::vector_size(4 * lane_count)]] = std::int32_t;

using Doubles [[gnu::vector_size(8 * lane_count)]] = double;

inline int max(int a, int b) { return a < b ? b : a; }
inline int min(int a, int b) { return b < a ? b : a; }
inline double max(double a, double b) { return a < b ? b : a; }
inline double min(double a, double b) { return b < a ? b : a; }

inline Reals everyReal(float a) { return a - Reals{}; }
inline Reals everyReal(double a) { return everyReal(static_cast<float>(a)); }
inline Reals everyReal(int a) { return everyReal(static_cast<float>(a)); }
inline Reals everyReal(const Ints& a) { return __builtin_convertvector(a, Reals); }
inline Ints everyInt(int a) { return a - Ints{}; }
inline Ints everyInt(const Reals& a) { return __builtin_convertvector(a, Ints); }
inline Ints everyBool(bool a) { return everyInt(a ? -1 : 0); }
inline Reals max(const Reals& a, const Reals& b) { return a < b ? b : a; }
inline Reals min(const Reals& a, const Reals& b) { return b < a ? b : a; }
#if VORPIPE_LANES == 16
// One instruction: compilers emit two, of which one waits for the other.
inline __mmask16 isPositive(const Reals& a) { return _mm512_cmp_ps_mask(a, Reals{}, _CMP_GT_OQ); }
inline Reals lesserWhere(const Reals& sign, const Reals& a, const Reals& b) {
  return _mm512_mask_min_ps(b, isPositive(sign), a, b);
}
inline Reals greaterWhere(const Reals& sign, const Reals& a, const Reals& b) {
  return _mm512_mask_max_ps(b, isPositive(sign), a, b);
}
#else
inline Reals lesserWhere(const Reals& sign, const Reals& a, const Reals& b) {
  return sign > 0 && a < b ? a : b;
}
inline Reals greaterWhere(const Reals& sign, const Reals& a, const Reals& b) {
  return sign > 0 && a > b ? a : b;
}
#endif
inline Ints max(const Ints& a, const Ints& b) { return a < b ? b : a; }
inline Ints min(const Ints& a, const Ints& b) { return b < a ? b : a; }
inline Doubles max(const Doubles& a, const Doubles& b) { return a < b ? b : a; }
inline Doubles min(const Doubles& a, const Doubles& b) { return b < a ? b : a; }
inline Reals abs(const Reals& a) { return reinterpret_cast<Reals>(reinterpret_cast<Ints>(a) & 0x7FFFFFFF); }
inline Reals sqrt(const Reals& a) {
  Reals root;
  for (int lane = 0; lane < lane_count; ++lane) root[lane] = __builtin_sqrtf(a[lane]);
  return root;
}
inline Reals toReals(const Doubles& a) { return __builtin_convertvector(a, Reals); }

inline bool anyOf(const Ints& truths) {
#if VORPIPE_LANES == 16
  const auto all = reinterpret_cast<__m512i>(truths);
  return _mm512_test_epi32_mask(all, all) != 0;
#else
  std::int64_t words[lane_count / 2];
  __builtin_memcpy(words, &truths, sizeof words);
  std::int64_t any = 0;
  for (const auto word : words) any |= word;
  return any != 0;
#endif
}

/// from[place] for each lane.
inline Doubles gather(const double* from, const Ints& place) {
  Doubles all;
  for (int lane = 0; lane < lane_count; ++lane) all[lane] = from[place[lane]];
  return all;
}
inline Ints gather(const std::uint32_t* from, const Ints& place) {
  Ints all;
  for (int lane = 0; lane < lane_count; ++lane) all[lane] = static_cast<int>(from[place[lane]]);
  return all;
}

/// The type names that the shared files use.
struct Many {
  using real = Reals;
  using cell_int = Ints;
  using cell_bool = Ints;
  struct vec2 {
    Reals x, y;
    vec2() = default;
    vec2(const Reals& first, const Reals& second) : x(first), y(second) {}
  };
  struct vec4 {
    Reals x, y, z, w;
    vec4() = default;
    vec4(const Reals& first, const Reals& second, const Reals& third, const Reals& fourth)
        : x(first), y(second), z(third), w(fourth) {}
  };
};

}  // namespace lanes
}  // namespace
}  // namespace vorpipe::cpu
