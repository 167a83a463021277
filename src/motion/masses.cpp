#include "vorpipe/masses.h"

#include <algorithm>
#include <cmath>

#include "base/block_sums.h"
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

Result<void> fillDomain(Session& session, std::size_t sites, double part, TransportOptions& options) {
  const auto whole = massOfDomain(session, options);
  if (!whole) return tl::unexpected(whole.error());
  auto& masses = options.masses;
  if (masses.empty()) masses.assign(sites, 1);
  if (masses.empty()) return {};
  if (!std::ranges::all_of(masses, [](double mass) { return std::isfinite(mass) && mass > 0; })) return {};
  // Divides by the greatest mass first: the sum of the given masses may overflow a double.
  const double greatest = *std::ranges::max_element(masses);
  const double sum =
      carefulSum(masses.size(), session.threads(), [&](std::size_t i) { return masses[i] / greatest; });
  for (double& mass : masses) mass = part * *whole * (mass / greatest / sum);
  return {};
}

}  // namespace vorpipe
