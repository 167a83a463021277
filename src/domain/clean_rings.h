/// From the rings of a clipped cell, which may run along each other, to simple ones (decision D123).
#pragma once

#include "domain/clip_cell.h"

namespace vorpipe::core {

/// Whether a point occurs twice in the rings: they touch, or run back along themselves.
bool touchesItself(const ClippedCell& cell);

/// Rewrites the rings of a cell, whose inside lies to their left but where they enclose nothing. What runs to
/// and fro between two points is taken away, unless it lies between two neighbors: ties left it no width.
/// What is one of the edges `near` of `outline` belongs to it. Rings then touch themselves nowhere, and each
/// other in single points; parts that meet in points have rings of their own. No ring may be left.
void cleanRings(const Rings& outline, std::span<const std::uint32_t> near, ClippedCell& cell);

/// The same for a cell whose edges have no order: edge k leads from vertex k of `cell` to ends[k], as many
/// edges end at each point as begin there, and `cell.ring_starts` is empty.
void cleanRings(const Rings& outline, std::span<const std::uint32_t> near, std::vector<Point> ends,
                ClippedCell& cell);

}  // namespace vorpipe::core
