/// How soft springs are to be, and whether those that are asked for go with a fluid.
#pragma once

#include <string>
#include <vector>

#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::moving {

/// The square root of the mean volume.
double meanSpacing(const std::vector<double>& volume);

/// For each site what a unit of its mass can lose by falling to the lowest corner of the domain: 0 and more
/// for those inside of it.
std::vector<double> fallOf(const FluidState& state, const FluidOptions& options);

/// The speed that springs are to stand: the largest first one, or half of that with which what is highest
/// reaches the lowest corner, its mean on the way. 0 where nothing moves and nothing pulls.
double usualSpeed(const FluidState& state, const FluidOptions& options);

/// Epsilon by default, a time: some spacings over the usual speed. Where there is none, a speed of the
/// domain's shorter side per unit of time is taken. The state has velocities and volumes.
double usualEpsilon(const FluidState& state, const FluidOptions& options);

/// Whether springs of this epsilon give way to a speed.
bool areTooSoft(double epsilon, double speed, double spacing, Surface surface);

/// A line where springs of this epsilon are much too soft or too stiff for a speed, and which would be right;
/// else empty.
std::string unfitFor(double epsilon, double speed, double spacing, Surface surface);

/// The longest step that springs stand: longer ones add energy without an end.
double longestStep(double epsilon);

/// What should be known of a fluid before its first step, a line each; its epsilon is chosen.
/// `is_chosen`: by default.
std::vector<std::string> notesBefore(const FluidState& state, const FluidOptions& options, bool is_chosen);

}  // namespace vorpipe::moving
