#include "vorpipe/masses.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vorpipe.h"

namespace vorpipe {

Result<double> massOfDomain(Session& session, const TransportOptions& options) {
  const Box& box = options.domain;
  CellsOptions cells{};
  cells.domain = box;
  cells.outline = options.outline;
  cells.periodic = options.periodic;
  cells.density = options.density;
  cells.detail = Detail::measures;
  cells.progress = options.progress;
  // The cell of a single site is the whole domain.
  const Sites site{{box.xmin + 0.5 * (box.xmax - box.xmin)}, {box.ymin + 0.5 * (box.ymax - box.ymin)}, {}};
  const auto whole = session.cells(site, cells);
  if (!whole) return tl::unexpected(whole.error());
  return whole->mass.empty() ? whole->area[0] : whole->mass[0];
}

void scaleTo(double whole, std::vector<double>& masses) {
  // As parts of the greatest first: the sum of masses as they are may be out of the range of a double.
  const double greatest = masses.empty() ? 0 : *std::ranges::max_element(masses);
  double sum = 0;
  for (const double mass : masses) sum += mass / greatest;
  if (!(std::isfinite(sum) && sum > 0)) return;
  for (double& mass : masses) mass = mass / greatest / sum * whole;
}

}  // namespace vorpipe
