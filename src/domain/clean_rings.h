/// Turns the rings of a clipped cell, which may run along each other, into simple ones (decision D123).
#pragma once

#include "domain/clip_cell.h"

namespace vorpipe::core {

/// Whether a point occurs twice in the rings: they touch, or run back along themselves.
bool touchesItself(const ClippedCell& cell);

/// Rewrites the rings of a cell, whose inside lies to their left unless they enclose nothing. Paths that run
/// back and forth between two points are removed, unless they lie between two neighbors: there ties left the
/// cell no width. Edges that coincide with an edge of `outline` in `near` belong to the outline. Afterwards
/// no ring touches itself, and rings touch each other only in single points; parts that meet in points have
/// separate rings. The result may have no rings.
void cleanRings(const Rings& outline, std::span<const std::uint32_t> near, ClippedCell& cell);

/// The same for a cell with unordered edges: edge k runs from vertex k of `cell` to ends[k]. As many edges
/// end at each point as begin there; `cell.ring_starts` is empty.
void cleanRings(const Rings& outline, std::span<const std::uint32_t> near, std::vector<Point> ends,
                ClippedCell& cell);

struct EdgePair {
  std::uint32_t e, f;
};

/// Adds each pair of edges that share more than ends. The test is exact for the vertices as they are. It
/// compares edges in `asked` with all others, and may add a pair twice. Two edges that run back and forth
/// between the same points do not count.
void findFaults(const ClippedCell& cell, std::span<const std::uint32_t> asked, std::vector<EdgePair>& faults);

}  // namespace vorpipe::core
