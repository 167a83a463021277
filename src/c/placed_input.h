/// Inputs as runs take them.
#pragma once

#include <memory>

#include "c/handles.h"

namespace vorpipe::c {

/// Finds the domain of an input, where that has not been done since its last change, and notes what was
/// mended or reinterpreted. Errors: those of findDomain (input).
Result<std::shared_ptr<const PlacedInput>> placedInput(const vorpipe_input& input);

/// Takes a diagram of this input back to degrees, if its sites were projected, and keeps its positions.
std::optional<PlanePositions> takeToDegrees(const PlacedInput& input, Diagram& diagram, int threads);

/// The system of all positions of a diagram.
const CoordinateSystem& systemOf(const PlacedInput& input);

}  // namespace vorpipe::c
