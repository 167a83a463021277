/// Chooses the softness of springs, and checks whether given springs suit a fluid.
#pragma once

#include <string>
#include <vector>

#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::moving {

/// Returns the square root of the mean volume.
double meanSpacing(const std::vector<double>& volume);

/// Returns for each site the energy that a unit of its mass can lose by falling to the lowest corner of the
/// domain. It is 0 or more for sites inside the domain.
std::vector<double> fallOf(const FluidState& state, const FluidOptions& options);

/// Returns the speed that springs must withstand. It is the largest initial speed, or half of the speed with
/// which the highest site reaches the lowest corner, its mean on the way. 0 if nothing moves and there is no
/// gravity.
double usualSpeed(const FluidState& state, const FluidOptions& options);

/// Returns the default epsilon, a time: some spacings over the usual speed. If that is 0, the speed is the
/// domain's shorter side per unit of time. The state has velocities and volumes.
double usualEpsilon(const FluidState& state, const FluidOptions& options);

/// Whether springs of this epsilon are too soft for a speed.
bool areTooSoft(double epsilon, double speed, double spacing, Surface surface);

/// Returns a line if springs of this epsilon are much too soft or too stiff for a speed, with the right
/// epsilon; else empty.
std::string unfitFor(double epsilon, double speed, double spacing, Surface surface);

/// Returns the longest stable step of springs: longer ones add energy without limit.
double longestStep(double epsilon);

/// Returns notes on a fluid before its first step, one per line. Its epsilon is already chosen. `is_chosen`:
/// by default.
std::vector<std::string> notesBefore(const FluidState& state, const FluidOptions& options, bool is_chosen);

}  // namespace vorpipe::moving
