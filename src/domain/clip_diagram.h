/// The cells of a diagram clipped to an outline.
#pragma once

#include "domain/own_parts.h"
#include "domain/rings.h"

namespace vorpipe::core {

/// Clips cells, which have polygons, to a valid outline, and writes what changes: ring_starts of all, and of
/// cells that the outline cuts everything else. A site without a part of the inside becomes `empty`. Measures
/// are those of cells before ties joined their corners, clipped as well; returns their parts. Two
/// cells are neighbors where each has an edge with the other, from the same point to the same; parts of edges
/// that the outline makes shorter than ties are, and those that run along it, belong to the outline; and what
/// of it lies on a wall belongs to the wall.
///
/// Errors (input): the outline is too far from the domain; areas that do not add up to the outline's.
Result<OwnParts> clipToOutline(const ClippedRun& run, const Outline& outline, Diagram& diagram);

}  // namespace vorpipe::core
