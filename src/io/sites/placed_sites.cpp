// Sites in degrees: recognizing them, and converting placed sites back to them; leaving sites out.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "io/sites/site_domain.h"

namespace vorpipe {

bool looksLikeDegrees(const Sites& sites, const CoordinateSystem& system) {
  constexpr double half_turn = 180, quarter = 90;
  if (system.kind != CoordinateKind::unknown) return system.kind == CoordinateKind::degrees;
  if (sites.size() == 0) return false;
  const auto [west, south, east, north] = boxOf(sites.x, sites.y);
  return west >= -half_turn && west < -quarter && east > quarter && east <= half_turn && south >= -quarter &&
         north <= quarter;
}

std::string hintAcrossAntimeridian(double west, double east) {
  constexpr double half_turn = 180, whole_turn = 360;
  if (!(west > 0 && west <= half_turn && east < 0 && east >= -half_turn)) return {};
  return fmt::format("; in degrees, across the antimeridian, xmax is {}", east + whole_turn);
}

std::string_view settleDegrees(const Sites& sites, CoordinateSystem& system) {
  constexpr double most_x = 360, most_y = 90;
  if (system.kind != CoordinateKind::degrees) return {};
  const auto within = [](double most) { return [most](double value) { return std::abs(value) <= most; }; };
  if (std::ranges::all_of(sites.x, within(most_x)) && std::ranges::all_of(sites.y, within(most_y))) return {};
  system = {};
  return "should hold degrees of longitude and latitude, and reaches beyond 360 or 90: it is taken as a "
         "plane";
}

Box boxOf(const std::vector<double>& x, const std::vector<double>& y) {
  const auto [west, east] = std::ranges::minmax(x);
  const auto [south, north] = std::ranges::minmax(y);
  return {west, south, east, north};
}

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
