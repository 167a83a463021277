#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {
namespace {

/// Counts the numbers that repeat others, up to rounding.
std::size_t countRepeated(std::vector<double> numbers) {
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  std::ranges::sort(numbers);
  const double near = rounding * std::max(std::abs(numbers.front()), std::abs(numbers.back()));
  std::size_t repeated = 0;
  for (std::size_t k = 1; k < numbers.size(); ++k) repeated += numbers[k] - numbers[k - 1] <= near ? 1u : 0u;
  return repeated;
}

}  // namespace

bool areOnLattice(const Sites& sites) {
  constexpr std::size_t most_looked_at = 4096, share = 8;
  const auto looked_at = std::min(sites.size(), most_looked_at);
  if (looked_at < 3) return false;
  std::vector<double> x, y, step_x, step_y;
  for (std::size_t k = 0; k < looked_at; ++k) {
    const auto i = k * (sites.size() - 1) / looked_at;
    x.push_back(sites.x[i]);
    y.push_back(sites.y[i]);
    step_x.push_back(sites.x[i + 1] - sites.x[i]);
    step_y.push_back(sites.y[i + 1] - sites.y[i]);
  }
  const auto areMany = [&](std::size_t repeated) { return share * repeated > looked_at; };
  return (areMany(countRepeated(std::move(x))) && areMany(countRepeated(std::move(y)))) ||
         (areMany(countRepeated(std::move(step_x))) && areMany(countRepeated(std::move(step_y))));
}

Result<Workload> workloadOf(const Sites& sites, const CellsOptions& options, ImagesFor purpose,
                            const DeviceInfo& device, int threads) {
  Workload work;
  work.sites = sites.size();
  work.weighted = !sites.weight.empty();
  work.outlined = !options.outline.empty();
  work.periodic = options.periodic != Periodic::none;
  work.density_pixels = options.density.values.size();
  work.search = options.search.method;
  work.backend = device.backend;
  work.device_on_host = device.type == "cpu";
  work.beside_drivers = device.beside_drivers;
  work.threads = threads;
  const auto all = sitesAndImages(sites, options.domain, options.periodic, purpose, threads);
  if (!all) return tl::unexpected(all.error());
  work.images = *all - work.sites;
  work.on_lattice = areOnLattice(sites);
  return work;
}

ImagesFor imagesFor(ColorBy color) {
  return color == ColorBy::area || color == ColorBy::neighbors ? ImagesFor::cells : ImagesFor::pictures;
}

}  // namespace vorpipe
