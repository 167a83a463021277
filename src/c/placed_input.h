/// Inputs in the form that runs need.
#pragma once

#include <memory>

#include "c/handles.h"

namespace vorpipe::c {

/// Finds the domain of an input, unless that was done since its last change, and notes what was repaired or
/// reinterpreted. Errors: those of findDomain (input).
Result<std::shared_ptr<const PlacedInput>> placedInput(const vorpipe_input& input);

/// Call this after changing something that the domain depends on: the domain is found anew, even if it was
/// kept.
void findAnew(vorpipe_input& input);

/// Converts a diagram of this input back to degrees, if its sites were projected, and returns its previous
/// positions.
std::optional<PlanePositions> takeToDegrees(const PlacedInput& input, Diagram& diagram, int threads);

/// Converts sites in the plane of an input to the caller's coordinates: to degrees if it is projected.
Sites shownSites(const PlacedInput& input, Sites sites);

/// Copies a placed input with other sites. The domain does not change, even if it was derived from the sites,
/// until findAnew().
std::unique_ptr<vorpipe_input> inputOf(const vorpipe_input& input, const PlacedInput& placed,
                                       const Sites& sites);

/// The coordinate system of all positions of a diagram.
const CoordinateSystem& systemOf(const PlacedInput& input);

}  // namespace vorpipe::c
