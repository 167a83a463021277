// Later steps on placed sites: leaving some out, and converting all back to degrees.
#include <cstddef>
#include <utility>
#include <vector>

#include "io/sites/site_domain.h"

namespace vorpipe {

void keepSites(PlacedSites& placed, std::vector<Attribute>& attributes, const std::vector<bool>& kept) {
  const auto keep = [&](std::vector<double>& numbers) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (kept[i]) numbers[to++] = numbers[i];
    }
    numbers.resize(to);
  };
  for (auto* numbers :
       {&placed.sites.x, &placed.sites.y, &placed.sites.weight, &placed.longitudes, &placed.latitudes})
    keep(*numbers);
  for (Attribute& attribute : attributes) {
    Attribute less(attribute.name(), attribute.type());
    for (std::size_t i = 0; i < attribute.size(); ++i) {
      if (kept[i]) less.add(attribute.at(i));
    }
    attribute = std::move(less);
  }
}

Sites sitesInDegrees(const Projection& projection, const Sites& before, const Sites& degrees, Sites sites) {
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const bool stays = i < before.size() && sites.x[i] == before.x[i] && sites.y[i] == before.y[i];
    const Point at =
        stays ? Point{degrees.x[i], degrees.y[i]} : projection.toDegrees({sites.x[i], sites.y[i]});
    sites.x[i] = at.x;
    sites.y[i] = at.y;
  }
  return sites;
}

Sites sitesInDegrees(const PlacedSites& placed, Sites sites) {
  if (!placed.projection) return sites;
  return sitesInDegrees(*placed.projection, placed.sites, {placed.longitudes, placed.latitudes, {}},
                        std::move(sites));
}

void backToDegrees(PlacedSites& placed, Diagram& diagram, int threads) {
  if (!placed.projection) return;
  placed.sites.x = std::move(placed.longitudes);
  placed.sites.y = std::move(placed.latitudes);
  toDegrees(*placed.projection, placed.sites, diagram, threads);
  placed.system = placed.degrees;
}

}  // namespace vorpipe
