/// The vocabulary of shaders/glsl/polyhedron.glsl with VORPIPE_LANES vertices side by side. As lane_words.h,
/// everything is in an anonymous namespace and uses no library templates.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <cstdint>

#define SLOTS 64
#define LANES VORPIPE_LANES
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

using lane_real [[gnu::vector_size(4 * VORPIPE_LANES)]] = float;
using lane_truth [[gnu::vector_size(4 * VORPIPE_LANES)]] = std::int32_t;

#if VORPIPE_LANES == 16
constexpr lane_truth each_lane{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
#elif VORPIPE_LANES == 8
constexpr lane_truth each_lane{0, 1, 2, 3, 4, 5, 6, 7};
#else
constexpr lane_truth each_lane{0, 1, 2, 3};
#endif

inline float max(float a, float b) { return a < b ? b : a; }
inline int min(int a, int b) { return b < a ? b : a; }
inline int max(int a, int b) { return a < b ? b : a; }

inline lane_real load(const float* from) {
  lane_real all;
  __builtin_memcpy(&all, from, sizeof all);
  return all;
}
inline lane_truth loadInts(const std::int32_t* from) {
  lane_truth all;
  __builtin_memcpy(&all, from, sizeof all);
  return all;
}
inline void store(std::int32_t* to, const lane_truth& all) { __builtin_memcpy(to, &all, sizeof all); }
inline void store(float* to, const lane_real& all) { __builtin_memcpy(to, &all, sizeof all); }

/// The truths of a comparison as bits. (One instruction with AVX-512: compilers emit three.)
#if VORPIPE_LANES == 16
inline std::uint32_t less(const lane_real& a, const lane_real& b) {
  return _mm512_cmp_ps_mask(reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b), _CMP_LT_OQ);
}
inline std::uint32_t less(const lane_truth& a, const lane_truth& b) {
  return _mm512_cmplt_epi32_mask(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b));
}
#else
inline std::uint32_t truths(const lane_truth& all) {
#if VORPIPE_LANES == 8
  return static_cast<std::uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(all)));
#elif defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(all)));
#else
  std::uint32_t bits = 0;
  for (int lane = 0; lane < VORPIPE_LANES; ++lane) bits |= all[lane] != 0 ? 1U << lane : 0;
  return bits;
#endif
}
inline std::uint32_t less(const lane_real& a, const lane_real& b) { return truths(a < b); }
inline std::uint32_t less(const lane_truth& a, const lane_truth& b) { return truths(a < b); }
#endif

inline float greatest(const lane_real& all) {
  lane_real most = all;
#if VORPIPE_LANES == 16
  most = GREATER(most,
                 __builtin_shufflevector(most, most, 8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7));
  most = GREATER(most, __builtin_shufflevector(most, most, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3));
  most = GREATER(most, __builtin_shufflevector(most, most, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1));
#elif VORPIPE_LANES == 8
  most = GREATER(most, __builtin_shufflevector(most, most, 4, 5, 6, 7, 0, 1, 2, 3));
  most = GREATER(most, __builtin_shufflevector(most, most, 2, 3, 0, 1, 2, 3, 0, 1));
#else
  most = GREATER(most, __builtin_shufflevector(most, most, 2, 3, 0, 1));
#endif
  return max(most[0], most[1]);
}

}  // namespace
}  // namespace vorpipe::space
