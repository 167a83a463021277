/// The words of shaders/glsl for several cells side by side: `real`, `cell_int` and `cell_bool` are vectors
/// of VORPIPE_LANES numbers, one cell each. Vectors of GCC and Clang, which have the operators of
/// numbers, also ?: with a vector of truths; sums and products are those of single floats, bit by bit.
///
/// For files that are compiled once for each set of instructions. All is in an anonymous namespace, and
/// nothing here comes from a library's templates: else the linker might take a copy that another file
/// compiled for instructions which this machine lacks.
#pragma once

#include <cstddef>
#include <cstdint>

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

inline int max(int a, int b) { return a < b ? b : a; }
inline int min(int a, int b) { return b < a ? b : a; }
inline float max(float a, float b) { return a < b ? b : a; }
inline float min(float a, float b) { return b < a ? b : a; }
inline double max(double a, double b) { return a < b ? b : a; }
inline double min(double a, double b) { return b < a ? b : a; }
inline float abs(float a) { return a < 0 ? -a : a; }
inline float floor(float a) {
  constexpr float no_fraction = 8388608;  // from here on floats are whole numbers
  if (!(abs(a) < no_fraction)) return a;
  const auto whole = static_cast<float>(static_cast<std::int32_t>(a));
  return whole > a ? whole - 1 : whole;
}

inline Reals everyReal(float a) { return a - Reals{}; }
inline Reals everyReal(double a) { return everyReal(static_cast<float>(a)); }
inline Reals everyReal(int a) { return everyReal(static_cast<float>(a)); }
inline Reals everyReal(const Ints& a) { return __builtin_convertvector(a, Reals); }
inline Ints everyInt(int a) { return a - Ints{}; }
inline Ints everyBool(bool a) { return everyInt(a ? -1 : 0); }
inline Reals max(const Reals& a, const Reals& b) { return a < b ? b : a; }
inline Ints max(const Ints& a, const Ints& b) { return a < b ? b : a; }
inline Reals abs(const Reals& a) { return a < 0 ? -a : a; }
inline Reals sqrt(const Reals& a) {
  Reals root;
  for (int lane = 0; lane < lane_count; ++lane) root[lane] = __builtin_sqrtf(a[lane]);
  return root;
}

inline Reals load(const float (&values)[lane_count]) {
  Reals all;
  __builtin_memcpy(&all, values, sizeof all);
  return all;
}
inline Ints load(const int (&values)[lane_count]) {
  Ints all;
  __builtin_memcpy(&all, values, sizeof all);
  return all;
}

/// The words of one cell: the walk over bins.
struct Single {
  using real = float;
  struct vec2 {
    float x, y;
  };
  struct vec4 {
    float x, y, z, w;
  };
};

/// The words of many: the clipping.
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
