/// The vocabulary of shaders/glsl/polyhedron.glsl with VORPIPE_LANES vertices side by side: floats, or with
/// VORPIPE_DOUBLES doubles, 8 of them. As lane_words.h, everything is in an anonymous namespace and uses no
/// library templates.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <cstdint>

#define SLOTS 64
#ifdef VORPIPE_DOUBLES
#define REAL double
#define LANES 8
#else
#define REAL float
#define LANES VORPIPE_LANES
#endif
#define MASK std::uint64_t
#define NO_SLOT \
  std::uint64_t { 0 }
#define SLOT(k) (std::uint64_t{1} << (k))
#define ANY_OF(m) ((m) != 0)
#define COUNT(m) __builtin_popcountll(m)
#define LOWEST(m) __builtin_ctzll(m)
#define LESS(a, b, block) (static_cast<std::uint64_t>(less(a, b)) << ((block)*LANES))
#define BLOCKS(m) ((63 + LANES - __builtin_clzll(m)) / LANES)
#define LOAD(array, block) load((array) + (block)*LANES)
#define STORE(array, block, value) store((array) + (block)*LANES, value)
#define NO_REAL (lane_real{})
#define GREATER(a, b) ((a) > (b) ? (a) : (b))
#define GREATEST(value) greatest(value)
#define INOUT(T) T&

namespace vorpipe::space {
namespace {

using lane_real [[gnu::vector_size(sizeof(REAL) * LANES)]] = REAL;
using lane_int [[gnu::vector_size(4 * LANES)]] = std::int32_t;

#if LANES == 16
constexpr lane_int each_lane{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
#elif LANES == 8
constexpr lane_int each_lane{0, 1, 2, 3, 4, 5, 6, 7};
#else
constexpr lane_int each_lane{0, 1, 2, 3};
#endif

inline REAL max(REAL a, REAL b) { return a < b ? b : a; }
inline int min(int a, int b) { return b < a ? b : a; }
inline int max(int a, int b) { return a < b ? b : a; }

inline lane_real load(const REAL* from) {
  lane_real all;
  __builtin_memcpy(&all, from, sizeof all);
  return all;
}
inline lane_int load(const std::int32_t* from) {
  lane_int all;
  __builtin_memcpy(&all, from, sizeof all);
  return all;
}
inline void store(std::int32_t* to, const lane_int& all) { __builtin_memcpy(to, &all, sizeof all); }
inline void store(REAL* to, const lane_real& all) { __builtin_memcpy(to, &all, sizeof all); }

/// The truths of a comparison, which are 0 or -1, as bits.
template <class Truths>
inline std::uint32_t truths(const Truths& all) {
  std::uint32_t bits = 0;
#if defined(__SSE2__)
  constexpr int in_part = 16 * LANES / sizeof all;
  __m128i part[sizeof all / 16];
  __builtin_memcpy(part, &all, sizeof all);
  for (int k = 0; k < LANES / in_part; ++k) {
    const int of_part = in_part == 4 ? _mm_movemask_ps(_mm_castsi128_ps(part[k]))
                                     : _mm_movemask_pd(_mm_castsi128_pd(part[k]));
    bits |= static_cast<std::uint32_t>(of_part) << k * in_part;
  }
#else
  for (int lane = 0; lane < LANES; ++lane) bits |= all[lane] != 0 ? 1U << lane : 0;
#endif
  return bits;
}

// With AVX-512 one instruction, of which compilers make three.
#if defined(__AVX512F__) && defined(VORPIPE_DOUBLES)
inline std::uint32_t less(const lane_real& a, const lane_real& b) {
  return _mm512_cmp_pd_mask(reinterpret_cast<__m512d>(a), reinterpret_cast<__m512d>(b), _CMP_LT_OQ);
}
inline std::uint32_t less(const lane_int& a, const lane_int& b) { return truths(a < b); }
#elif defined(__AVX512F__)
inline std::uint32_t less(const lane_real& a, const lane_real& b) {
  return _mm512_cmp_ps_mask(reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b), _CMP_LT_OQ);
}
inline std::uint32_t less(const lane_int& a, const lane_int& b) {
  return _mm512_cmplt_epi32_mask(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b));
}
#else
inline std::uint32_t less(const lane_real& a, const lane_real& b) { return truths(a < b); }
inline std::uint32_t less(const lane_int& a, const lane_int& b) { return truths(a < b); }
#endif

inline REAL greatest(const lane_real& all) {
  lane_real most = all;
#if LANES == 16
  most = GREATER(most,
                 __builtin_shufflevector(most, most, 8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7));
  most = GREATER(most, __builtin_shufflevector(most, most, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3));
  most = GREATER(most, __builtin_shufflevector(most, most, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1));
#elif LANES == 8
  most = GREATER(most, __builtin_shufflevector(most, most, 4, 5, 6, 7, 0, 1, 2, 3));
  most = GREATER(most, __builtin_shufflevector(most, most, 2, 3, 0, 1, 2, 3, 0, 1));
#else
  most = GREATER(most, __builtin_shufflevector(most, most, 2, 3, 0, 1));
#endif
  return max(most[0], most[1]);
}

}  // namespace
}  // namespace vorpipe::space
