#include "motion/site_energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/block_sums.h"
#include "base/try.h"

namespace vorpipe::moving {
namespace {

/// The contribution of a block of sites to the totals.
struct Part {
  CarefulSum energy, scale, area;
  double farthest = 0;
  std::uint64_t cells = 0, lost = 0;
};

using Site = std::uint32_t;

/// Seats `guests` around the host's new position, well inside a round cell of its area, in the pattern of a
/// sunflower's seeds: no two positions coincide.
void seat(Site host, const std::vector<Site>& guests, double turned, const CellMoments& moments,
          const Seats& seats, Sites& places) {
  constexpr double golden_angle = 2.399963229728653, part_of_cell = 0.25;
  const double reach = part_of_cell * std::sqrt(moments.area[host]);
  const auto count = static_cast<double>(guests.size());
  for (std::size_t k = 0; k < guests.size(); ++k) {
    const double rank = static_cast<double>(k) + 0.5, angle = golden_angle * (rank + turned);
    const double far = reach * std::sqrt(rank / count);
    const Point place =
        seats.beside({places.x[host], places.y[host]}, far * std::cos(angle), far * std::sin(angle));
    places.x[guests[k]] = place.x;
    places.y[guests[k]] = place.y;
  }
}

std::uint64_t seatDuplicates(const Sites& sites, const CellMoments& moments, const Seats& seats,
                             Sites& places) {
  std::map<std::pair<double, double>, std::vector<Site>> guests;
  std::uint64_t count = 0;
  for (Site i = 0; i < sites.size(); ++i) {
    if (moments.status[i] != Status::duplicate) continue;
    guests[{sites.x[i], sites.y[i]}].push_back(i);
    ++count;
  }
  for (Site i = 0; i < sites.size() && !guests.empty(); ++i) {
    if (moments.status[i] != Status::ok) continue;
    const auto found = guests.find({sites.x[i], sites.y[i]});
    if (found == guests.end()) continue;
    seat(i, found->second, static_cast<double>(i), moments, seats, places);
  }
  return count;
}

/// Returns the cells with the most energy, in descending order: as many as there are guests, if there are
/// enough.
std::vector<Site> costliest(const Sites& sites, const CellMoments& moments, const Seats& seats,
                            std::size_t count) {
  std::vector<std::pair<double, Site>> cells;
  for (Site i = 0; i < sites.size(); ++i) {
    if (moments.status[i] != Status::ok || !(moments.mass[i] > 0)) continue;
    cells.emplace_back(-seats.energyOf(sites, i), i);
  }
  count = std::min(count, cells.size());
  std::ranges::partial_sort(cells, cells.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<Site> hosts;
  for (std::size_t k = 0; k < count; ++k) hosts.push_back(cells[k].second);
  return hosts;
}

void seatMassless(const Sites& sites, const CellMoments& moments, const std::vector<Site>& massless,
                  const Seats& seats, Sites& places) {
  const auto hosts = costliest(sites, moments, seats, massless.size());
  if (hosts.empty()) return;
  std::vector<std::vector<Site>> guests(hosts.size());
  for (std::size_t k = 0; k < massless.size(); ++k) guests[k % hosts.size()].push_back(massless[k]);
  for (std::size_t k = 0; k < hosts.size(); ++k) {
    seat(hosts[k], guests[k], static_cast<double>(k), moments, seats, places);
  }
}

}  // namespace

MeasuredSites measureSites(const Sites& sites, const CellMoments& moments, const AllowedPlaces& allowed,
                           int threads) {
  const std::size_t count = sites.size();
  MeasuredSites measured;
  measured.gradient.resize(2 * count);
  measured.inverse.resize(2 * count);
  measured.way.resize(2 * count);
  const auto measureSite = [&](std::size_t i, Part& part) {
    const bool has_cell = moments.status[i] == Status::ok;
    const double mass = has_cell ? moments.mass[i] : 0;
    if (has_cell) ++part.cells;
    part.area.add(has_cell ? moments.area[i] : 0);
    if (!(mass > 0)) {
      ++part.lost;
      return;
    }
    const double x = sites.x[i], y = sites.y[i];
    const Point centroid = moments.centroid[i], target = allowed.nearestTo(centroid);
    const double dx = centroid.x - x, dy = centroid.y - y;
    const double own = moments.spread[i] + mass * (dx * dx + dy * dy);
    const double weighted = sites.weight.empty() ? 0 : mass * sites.weight[i];
    part.energy.add(own);
    part.energy.add(-weighted);
    part.scale.add(own + std::abs(weighted));
    measured.gradient[i] = -2 * mass * dx;
    measured.gradient[count + i] = -2 * mass * dy;
    measured.inverse[i] = measured.inverse[count + i] = 1 / (2 * mass);
    measured.way[i] = target.x - x;
    measured.way[count + i] = target.y - y;
    // hypot takes as long as all the rest: it is called only for ways that may be the longest so far.
    const double side = std::max(std::abs(target.x - x), std::abs(target.y - y));
    if (1.5 * side > part.farthest) {
      part.farthest = std::max(part.farthest, std::hypot(target.x - x, target.y - y));
    }
  };
  const auto parts = byBlocks<Part>(count, threads, [&](std::size_t begin, std::size_t end) {
    Part part;
    for (auto i = begin; i < end; ++i) measureSite(i, part);
    return part;
  });
  Part all;
  for (const Part& part : parts) {
    all.energy.add(part.energy.value());
    all.scale.add(part.scale.value());
    all.area.add(part.area.value());
    all.farthest = std::max(all.farthest, part.farthest);
    all.cells += part.cells;
    all.lost += part.lost;
  }
  measured.energy = all.energy.value();
  measured.scale = all.scale.value();
  measured.area = all.area.value();
  measured.farthest = all.farthest;
  measured.cells = all.cells;
  measured.has_lost = all.lost > 0;
  return measured;
}

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
  VORPIPE_LET(cells, session.cells(sites, options));
  return latticeEnergy(
      carefulSum(cells.mass.size(), session.threads(), [&](std::size_t i) { return cells.mass[i]; }));
}

std::vector<std::string> LostSites::notes() const {
  std::vector<std::string> lines;
  const auto say = [&](std::uint64_t count, const char* what) {
    if (count > 0) lines.push_back(fmt::format("{} {} {}", count, count == 1 ? "site" : "sites", what));
  };
  say(duplicates, "at the place of another: set beside it");
  say(outside, "outside of the domain: moved into it");
  say(massless, "in cells without mass: moved into cells that have much");
  say(hidden, "without a cell, hidden by others of larger weight: left in place");
  return lines;
}

LostSites placeLostSites(const Sites& sites, const CellMoments& moments, const Seats& seats, Sites& places) {
  LostSites lost;
  std::vector<Site> massless;
  for (Site i = 0; i < sites.size(); ++i) {
    if (moments.status[i] == Status::ok && !(moments.mass[i] > 0)) massless.push_back(i);
    if (moments.status[i] != Status::empty) continue;
    const Point place{sites.x[i], sites.y[i]};
    if (seats.contain(place)) {
      ++lost.hidden;
      continue;
    }
    const Point inside = seats.nearestTo(place);
    places.x[i] = inside.x;
    places.y[i] = inside.y;
    ++lost.outside;
  }
  lost.duplicates = seatDuplicates(sites, moments, seats, places);
  lost.massless = massless.size();
  seatMassless(sites, moments, massless, seats, places);
  return lost;
}

}  // namespace vorpipe::moving
