/// Files from which a fluid simulation continues.
#pragma once

#include <string>

#include "io/base/byte_sink.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe {

/// Writes all that a later step depends on as an .npz file: sites (N, 2), weights (N), velocity (N, 2),
/// volume (N), density (N), pressure (N), trend (N), order uint32 (N); domain (4), gravity (2), carried (2);
/// time, until, length, epsilon and tolerance (1); step and diagrams uint64 (1); periodic, surface and scheme
/// uint8 (1), which number the values of their options from 0; float64 unless stated. Where they say
/// something, also viscosity and centering (1), walls and case uint8 (1), and of an outline `outline` (N, 2),
/// outline_rings and outline_polygons uint64, its offsets. Leaves out arrays that a state does not have.
/// Error (device): writing failed.
Result<void> writeFluid(ByteSink& sink, const FluidState& state, const FluidOptions& options);

/// Reads such a file; only the arrays `sites` and `domain` are required. Numbers may be of any type, and
/// option names be written out. Errors (input): those of NpzFile; an array of another name. Fluid::begin
/// checks whether arrays match the sites.
Result<FluidSetup> readFluid(const std::string& path);

}  // namespace vorpipe
