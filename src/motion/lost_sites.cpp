#include "motion/lost_sites.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace vorpipe::moving {
namespace {

using Site = std::uint32_t;

/// Places sites beside others, in the pattern of a sunflower's seeds: no two places coincide.
class Seats {
 public:
  Seats(const CellMoments& moments, const AllowedPlaces& allowed, Sites& places)
      : moments_(moments), allowed_(allowed), places_(places) {}

  /// Seats `guests` around the host's new place, well inside a round cell of its area.
  void seat(Site host, const std::vector<Site>& guests, double turned) {
    constexpr double golden_angle = 2.399963229728653, part_of_cell = 0.25;
    const double reach = part_of_cell * std::sqrt(moments_.area[host]);
    const auto count = static_cast<double>(guests.size());
    for (std::size_t k = 0; k < guests.size(); ++k) {
      const double rank = static_cast<double>(k) + 0.5, angle = golden_angle * (rank + turned);
      const double far = reach * std::sqrt(rank / count);
      const Point place = allowed_.nearestTo(
          {places_.x[host] + far * std::cos(angle), places_.y[host] + far * std::sin(angle)});
      places_.x[guests[k]] = place.x;
      places_.y[guests[k]] = place.y;
    }
  }

 private:
  const CellMoments& moments_;
  const AllowedPlaces& allowed_;
  Sites& places_;
};

std::uint64_t seatDuplicates(const Sites& sites, const CellMoments& moments, Seats& seats) {
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
    if (found != guests.end()) seats.seat(i, found->second, static_cast<double>(i));
  }
  return count;
}

/// Returns the cells with the most energy, in descending order: as many as there are guests, if there are
/// enough.
std::vector<Site> costliest(const Sites& sites, const CellMoments& moments, std::size_t count) {
  std::vector<std::pair<double, Site>> cells;
  for (Site i = 0; i < sites.size(); ++i) {
    if (moments.status[i] != Status::ok || !(moments.mass[i] > 0)) continue;
    const double dx = moments.centroid[i].x - sites.x[i], dy = moments.centroid[i].y - sites.y[i];
    cells.emplace_back(-(moments.spread[i] + moments.mass[i] * (dx * dx + dy * dy)), i);
  }
  count = std::min(count, cells.size());
  std::ranges::partial_sort(cells, cells.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<Site> hosts;
  for (std::size_t k = 0; k < count; ++k) hosts.push_back(cells[k].second);
  return hosts;
}

void seatMassless(const Sites& sites, const CellMoments& moments, const std::vector<Site>& massless,
                  Seats& seats) {
  const auto hosts = costliest(sites, moments, massless.size());
  if (hosts.empty()) return;
  std::vector<std::vector<Site>> guests(hosts.size());
  for (std::size_t k = 0; k < massless.size(); ++k) guests[k % hosts.size()].push_back(massless[k]);
  for (std::size_t k = 0; k < hosts.size(); ++k) seats.seat(hosts[k], guests[k], static_cast<double>(k));
}

}  // namespace

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

LostSites placeLostSites(const Sites& sites, const CellMoments& moments, const AllowedPlaces& allowed,
                         Sites& places) {
  LostSites lost;
  std::vector<Site> massless;
  for (Site i = 0; i < sites.size(); ++i) {
    if (moments.status[i] == Status::ok && !(moments.mass[i] > 0)) massless.push_back(i);
    if (moments.status[i] != Status::empty) continue;
    const Point place{sites.x[i], sites.y[i]};
    if (allowed.contain(place)) {
      ++lost.hidden;
      continue;
    }
    const Point inside = allowed.nearestTo(place);
    places.x[i] = inside.x;
    places.y[i] = inside.y;
    ++lost.outside;
  }
  Seats seats(moments, allowed, places);
  lost.duplicates = seatDuplicates(sites, moments, seats);
  lost.massless = massless.size();
  seatMassless(sites, moments, massless, seats);
  return lost;
}

}  // namespace vorpipe::moving
