/// The shared files for several cells at once. See lane_words.h.
#pragma once

#include "backend/cpu/lane_words.h"
#include "layout.glsl"

namespace vorpipe::cpu {
namespace {
namespace lanes {

constexpr std::size_t width = lane_count;

#ifdef WEIGHTED
/// Returns differences of weights, clamped: larger ones lie beyond any domain, and squares must be finite.
inline Reals differenceOf(const Doubles& own, const Doubles& other) {
  const Doubles most = 1e18 - Doubles{};
  return toReals(max(-most, min(most, own - other)));
}
#endif

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

  const double *sites_x, *sites_y;  ///< all sites
  const std::uint32_t* bin_starts;  ///< of their grid
  Doubles site_x, site_y;           ///< the sites of the cells
  [[nodiscard]] cell_int firstOfBin(const cell_int& bin) const { return gather(bin_starts, bin); }
  [[nodiscard]] vec2 offsetTo(const cell_int& index) const {
    return {toReals(gather(sites_x, index) - site_x), toReals(gather(sites_y, index) - site_y)};
  }
#ifdef WEIGHTED
  const double *weights, *heaviest;
  const std::uint32_t* heavy;
  Doubles weight;  ///< of the cells' sites
  [[nodiscard]] real weightDifference(const cell_int& index) const {
    return differenceOf(weight, gather(weights, index));
  }
  [[nodiscard]] int heavyAt(int k) const { return static_cast<int>(heavy[k]); }
  [[nodiscard]] real weightExcess(const cell_int& number) const {
    const real weight_excess = -differenceOf(weight, gather(heaviest, number));
    return weight_excess + abs(weight_excess) * 1.2e-7F;
  }
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
