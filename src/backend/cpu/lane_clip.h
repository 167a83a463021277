/// The shared files for several cells side by side: bins for one after the other, clipping for all at once.
/// See lane_words.h.
#pragma once

#include "backend/cpu/lane_words.h"
#include "layout.glsl"

namespace vorpipe::cpu {
namespace {
namespace lanes {

constexpr std::size_t width = lane_count;

#ifdef WEIGHTED
/// A difference of weights. What is larger than this lies beyond any domain, and squares must be finite.
inline float leadOver(double own, double other) {
  constexpr double most = 1e18;
  return static_cast<float>(max(-most, min(most, own - other)));
}
#endif

#define FAR 1e30F

/// The bins, for one cell after the other.
template <class Words>
struct Walk {
  using real = typename Words::real;
  using vec2 = typename Words::vec2;
  using vec4 = typename Words::vec4;

  const std::uint32_t* bin_starts = nullptr;
  [[nodiscard]] int firstOfBin(int bin) const { return static_cast<int>(bin_starts[bin]); }

#ifdef WEIGHTED
  const double* heaviest = nullptr;
  const std::uint32_t* heavy = nullptr;
  double weight = 0;  ///< of the cell's site
  [[nodiscard]] int heavyAt(int k) const { return static_cast<int>(heavy[k]); }
  [[nodiscard]] real leadOf(int number) const {
    const real lead = -leadOver(weight, heaviest[number]);
    return lead + abs(lead) * 1.2e-7F;
  }
#endif

#include "bins.glsl"
};

#undef FAR

// From here on a constant is one for every cell.
#define ROUNDING everyReal(5.9604645e-8F)
#define FAR everyReal(1e30F)
#define NOWHERE everyReal(1e-36F)
#define SAME everyReal(1e-30F)
#define real(...) everyReal(__VA_ARGS__)
#define cell_int(...) everyInt(__VA_ARGS__)
#define cell_bool(...) everyBool(__VA_ARGS__)

template <class Words, int Edges>
struct Clip {
  using real = typename Words::real;
  using cell_int = typename Words::cell_int;
  using cell_bool = typename Words::cell_bool;
  using vec2 = typename Words::vec2;
  using vec4 = typename Words::vec4;
  static constexpr int MAX_EDGES = Edges;

  vec2 offset;  ///< to the site that is tried next
  [[nodiscard]] vec2 offsetTo(const cell_int&) const { return offset; }
  [[nodiscard]] int firstOfBin(int) const;  // of the walk alone
#ifdef WEIGHTED
  real against_next;  ///< the weight of the cell's site minus that of the one that is tried next
  [[nodiscard]] real weightAgainst(const cell_int&) const { return against_next; }
  [[nodiscard]] int heavyAt(int) const;  // of the walk alone, like the next
  [[nodiscard]] real leadOf(int) const;
#endif

#include "cell.glsl"
#include "grid.glsl"
};

#undef real
#undef cell_int
#undef cell_bool

}  // namespace lanes
}  // namespace
}  // namespace vorpipe::cpu
