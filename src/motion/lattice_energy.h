/// The energy that relaxation is measured by: that of the hexagonal lattice, which no Voronoi diagram of as
/// many cells in as large a domain has less than (L. Fejes Toth; with a density, in the limit of many,
/// Gersho).
#pragma once

#include "vorpipe.h"

namespace vorpipe::moving {

/// Times the number of cells, of a domain of this area.
double latticeEnergy(double area);

/// The same under the density of `options`, at which cells are as large as relaxed ones there: the square
/// root of the density takes the place of area. Errors: those of Session::cells.
Result<double> latticeEnergy(Session& session, const Sites& sites, CellsOptions options);

}  // namespace vorpipe::moving
