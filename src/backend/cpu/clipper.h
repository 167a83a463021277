/// shaders/glsl/cell.glsl and grid.glsl, compiled by the C++ compiler: the shared algorithm on the CPU.
#pragma once

#include "backend/backend.h"
#include "backend/cpu/glsl.h"
#include "layout.glsl"

namespace vorpipe::cpu {

/// Clips cells of at most Room edges with numbers of type Real. `lines` is the list that lineAt reads,
/// `sites` the set that firstOfBin and offsetTo read. One Clipper serves one thread.
template <class Real, std::size_t Room>
struct Clipper {
  using real = Real;
  using vec2 = Vec2<Real>;
  using vec4 = Vec4<Real>;
  static constexpr int MAX_EDGES = static_cast<int>(Room);
  static_assert(MAX_EDGES % 4 == 0);

  const HalfPlane<Real>* lines = nullptr;
  const SiteSet* sites = nullptr;
  double site_x = 0, site_y = 0;  ///< the site whose cell is clipped
  int used_edges = MAX_EDGES;     ///< where loops over slots end if Room exceeds 64; a multiple of 4

  /// Returns where loops over the slots end: a constant if there are few, which compilers unroll.
  [[nodiscard]] int edgeEnd() const {
    if constexpr (Room > 64) return used_edges;
    return MAX_EDGES;
  }

  [[nodiscard]] vec4 lineAt(int index) const {
    const auto& line = lines[index];
    return vec4(line.nx, line.ny, line.h, line.bound);
  }

  [[nodiscard]] int firstOfBin(int bin) const {
    return static_cast<int>(sites->grid.offsets[static_cast<std::size_t>(bin)]);
  }

  /// The difference is taken in double, then rounded.
  [[nodiscard]] vec2 offsetTo(int index) const {
    const auto i = static_cast<std::size_t>(index);
    return vec2(static_cast<Real>(sites->x[i] - site_x), static_cast<Real>(sites->y[i] - site_y));
  }

#include "cell.glsl"
#include "grid.glsl"
#include "list.glsl"

  /// Clips an entry of a batch whose lines `lines` points to.
  CellStatus clip(Cell& cell, const typename CellBatch<Real>::Entry& entry, vec2 outset) {
    return static_cast<CellStatus>(clipCell(cell, vec4(entry.west, entry.south, entry.east, entry.north),
                                            outset, static_cast<int>(entry.first),
                                            static_cast<int>(entry.count), entry.reach, entry.origin_offset));
  }
};

}  // namespace vorpipe::cpu
