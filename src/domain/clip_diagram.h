/// The cells of a diagram clipped to an outline.
#pragma once

#include "domain/own_parts.h"
#include "domain/rings.h"

namespace vorpipe::core {

/// Clips cells with polygons to a valid outline, and writes what changes: ring_starts of all cells, and
/// everything else of cells that the outline cuts. A site without a part of the inside becomes `empty`.
/// Measures are those of cells before ties joined their corners, clipped as well; returns the parts of these
/// cells. Two cells are neighbors if each has an edge with the other, between the same two points. Edges that
/// run along the outline belong to it, and so do parts of edges that it makes shorter than ties. Parts of the
/// outline that lie on a wall belong to the wall.
///
/// Errors (input): the outline is too far from the domain; areas that do not add up to the outline's.
Result<OwnParts> clipToOutline(const ClippedRun& run, const Outline& outline, Diagram& diagram);

}  // namespace vorpipe::core
