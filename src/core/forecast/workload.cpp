#include "vorpipe.h"

namespace vorpipe {

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
  work.spread = spreadOf(sites, options.domain, threads);
  return work;
}

ImagesFor imagesFor(ColorBy color) {
  return color == ColorBy::area || color == ColorBy::neighbors ? ImagesFor::cells : ImagesFor::pictures;
}

}  // namespace vorpipe
