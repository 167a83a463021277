#include "motion/lattice_energy.h"

#include <cmath>
#include <utility>

#include "base/block_sums.h"

namespace vorpipe::moving {

double latticeEnergy(double area) {
  const double of_unit_cell = 5 / (18 * std::sqrt(3.0));
  return of_unit_cell * area * area;
}

Result<double> latticeEnergy(Session& session, const Sites& sites, CellsOptions options) {
  Density& density = options.density;
  for (double& value : density.values) value = std::sqrt(value);
  if (options.outline.empty() && !density.box) {
    const auto [xmin, ymin, xmax, ymax] = options.domain;
    const double pixel = (xmax - xmin) / density.width * ((ymax - ymin) / density.height);
    return latticeEnergy(pixel * carefulSum(density.values.size(), session.threads(),
                                            [&](std::size_t k) { return density.values[k]; }));
  }
  // The cells divide the mass inside the outline, or inside the density's box, within the domain.
  options.detail = Detail::measures;
  const auto cells = session.cells(sites, options);
  if (!cells) return tl::unexpected(cells.error());
  return latticeEnergy(
      carefulSum(cells->mass.size(), session.threads(), [&](std::size_t i) { return cells->mass[i]; }));
}

}  // namespace vorpipe::moving
