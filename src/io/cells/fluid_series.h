/// Writes steps of a fluid as files for ParaView.
#pragma once

#include <string>
#include <vector>

#include "io/base/byte_sink.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe {

/// Writes a step as a .vtp file: a polygon for each cell with its site, velocity, pressure, volume and
/// density. `diagram` has the cells of its sites in the options' domain, with Detail::polygons; with a free
/// surface, discs cut them, as polygons with enough corners to look round. Errors: those of cellsMesh();
/// writing failed (device).
Result<void> writeFluidStep(ByteSink& sink, const FluidState& state, const FluidOptions& options,
                            const Diagram& diagram);

/// A file of the series.
struct SeriesStep {
  double time;
  std::string file;  ///< its name, without the folder of the series
};

/// Writes the .pvd file that names all files of a series with their times.
Result<void> writeSeries(ByteSink& sink, const std::vector<SeriesStep>& steps);

/// Reads what writeSeries wrote. Errors (input): it cannot be read; a line that writeSeries does not write.
Result<std::vector<SeriesStep>> readSeries(const std::string& path);

}  // namespace vorpipe
