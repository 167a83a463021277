/// Whether what a peer says of cells in space is what vorpipe says.
#pragma once

#include <string>

#include "bench/peers/space_peer.h"

namespace vorpipe::test {

/// In how many cells the volume, or a face, is not that of the reference, or nothing. A face that has no more
/// area than ties leave may be missing.
std::string disagreement(const SpaceInput& input, const MeasuredInSpace& measured, const Diagram3& reference);

/// By how much the number of tetrahedra is not what the reference's vertices leave possible, or nothing.
/// Where more than four sites meet, it is not known how a peer takes them apart.
std::string disagreement(const TriangulatedInSpace& triangulated, const Diagram3& reference);

}  // namespace vorpipe::test
