/// The shared files for several cells side by side: bins for one after the other, clipping for all at once.
/// See lane_words.h.
#pragma once

#include "backend/cpu/lane_words.h"
#include "layout.glsl"

namespace vorpipe::cpu {
namespace {
namespace lanes {

constexpr std::size_t width = lane_count;

/// The bins, for one cell after the other.
template <class Words>
struct Walk {
  using real = typename Words::real;
  using vec2 = typename Words::vec2;
  using vec4 = typename Words::vec4;

  const std::uint32_t* first = nullptr;
  [[nodiscard]] int firstOfBin(int bin) const { return static_cast<int>(first[bin]); }

#include "bins.glsl"
};

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

#include "cell.glsl"
#include "grid.glsl"
};

#undef real
#undef cell_int
#undef cell_bool

/// Sites to try, for one cell.
struct Feed {
  struct Run {
    int place, end;
  };
  Run run[8];
  int next, runs;
  int count;

  void clear() { next = runs = count = 0; }
  void add(int place, int end) {
    if (place >= end) return;
    run[runs++] = {place, end};
    count += end - place;
  }
  /// The next site, or `none` after the last.
  int take(int none) {
    if (next == runs) return none;
    auto& now = run[next];
    const int place = now.place++;
    if (now.place == now.end) ++next;
    return place;
  }
};

}  // namespace lanes
}  // namespace
}  // namespace vorpipe::cpu
