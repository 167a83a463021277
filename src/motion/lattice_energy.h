/// The reference energy of relaxation: that of the hexagonal lattice. No Voronoi diagram of as many cells in
/// as large a domain has less (L. Fejes Toth; with a density, in the limit of many cells, Gersho).
#pragma once

#include "vorpipe.h"

namespace vorpipe::moving {

/// Returns that energy for a domain of this area, times the number of cells.
double latticeEnergy(double area);

/// The same under the density of `options`, with cells as large as relaxed ones there: the integral of the
/// square root of the density replaces the area. Errors: those of Session::cells.
Result<double> latticeEnergy(Session& session, const Sites& sites, CellsOptions options);

}  // namespace vorpipe::moving
