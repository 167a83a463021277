/// The initial fluid, from a program's options.
#pragma once

#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::c {

/// Sets up a fluid from an input and `placed`, its placed form. Errors (input): an outline, a projection or a
/// density; arrays that do not match its sites; a number that names nothing.
Result<FluidSetup> fluidSetup(const vorpipe_input& input, const PlacedInput& placed,
                              const vorpipe_fluid_options& wanted);

/// Sets up a fluid from a case or a file, with about `parcels` cells. Errors (input): there is no such case;
/// those of readFluid; arrays, which it has itself.
Result<FluidSetup> fluidSetup(const std::string& name, std::uint64_t parcels,
                              const vorpipe_fluid_options& wanted);

/// Converts the result of a step to the form of vorpipe_c.h.
vorpipe_fluid_figures figuresOf(const FluidStep& step);

}  // namespace vorpipe::c
