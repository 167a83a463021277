/// Inputs as runs take them.
#pragma once

#include <memory>

#include "c/handles.h"

namespace vorpipe::c {

/// Finds the domain of an input, where that has not been done since its last change, and notes what was
/// mended or reinterpreted. Errors: those of findDomain (input).
Result<std::shared_ptr<const PlacedInput>> placedInput(const vorpipe_input& input);

/// Something that the domain depends on has changed: it is found anew, even where it was kept.
void findAnew(vorpipe_input& input);

/// Takes a diagram of this input back to degrees, if its sites were projected, and keeps its positions.
std::optional<PlanePositions> takeToDegrees(const PlacedInput& input, Diagram& diagram, int threads);

/// Sites of the plane of an input, as its caller has them: in degrees where it is projected.
Sites shownSites(const PlacedInput& input, Sites sites);

/// An input like one that was placed, whose sites have become others. The domain stays as it was found, even
/// where it was that of the sites, until findAnew().
std::unique_ptr<vorpipe_input> inputOf(const vorpipe_input& input, const PlacedInput& placed,
                                       const Sites& sites);

/// The system of all positions of a diagram.
const CoordinateSystem& systemOf(const PlacedInput& input);

}  // namespace vorpipe::c
