/// What a fluid begins with, from what a program gave.
#pragma once

#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::c {

/// Of an input, which `placed` is of. Errors (input): an outline, a projection or a density; arrays that are
/// not of its sites; a number that names nothing.
Result<FluidSetup> fluidSetup(const vorpipe_input& input, const PlacedInput& placed,
                              const vorpipe_fluid_options& wanted);

/// Of a case or a file, with about `parcels` cells. Errors (input): there is no such case; those of
/// readFluid; arrays, which it has itself.
Result<FluidSetup> fluidSetup(const std::string& name, std::uint64_t parcels,
                              const vorpipe_fluid_options& wanted);

/// The result of a step, as in vorpipe_c.h.
vorpipe_fluid_figures figuresOf(const FluidStep& step);

}  // namespace vorpipe::c
