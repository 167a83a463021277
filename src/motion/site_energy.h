/// The energy of sites, the least that it can be, and sites that contribute none.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motion/movable.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// By site, in input order. Vectors of two numbers for each site have all x first, then all y; on the globe
/// there are three.
struct MeasuredSites {
  std::vector<double> gradient;  ///< of the energy: 2 m (p - c)
  std::vector<double> inverse;   ///< 1 / (2 m); 0 where there is no mass
  std::vector<double> way;       ///< to the centroid, or to the allowed place nearest to it
  double energy = 0;
  double hexagonal = 0;  ///< as RelaxStep::hexagonal; not a number with weights
  double scale = 0;      ///< the same sum of absolute values: rounding errors are relative to this
  double area = 0;       ///< of all cells
  double farthest = 0;   ///< the longest of `way`, in the caller's unit
  std::uint64_t cells = 0;
  bool has_lost = false;  ///< some sites have no mass
};

/// Returns the energy of a site without its weight: its cell's mass times squared distances to the site.
inline double energyOf(const Sites& sites, const CellMoments& moments, std::size_t i) {
  const double dx = moments.centroid[i].x - sites.x[i], dy = moments.centroid[i].y - sites.y[i];
  return moments.spread[i] + moments.mass[i] * (dx * dx + dy * dy);
}

/// Measures sites at the places of the moments, along periodic axes as placed by wrapped().
MeasuredSites measureSites(const Sites& sites, const CellMoments& moments, const AllowedPlaces& allowed,
                           int threads);

/// Returns the energy of the hexagonal lattice in a domain of this area, times the number of cells. No
/// Voronoi diagram of as many cells has less (L. Fejes Toth; with a density, in the limit of many cells,
/// Gersho).
double latticeEnergy(double area);

/// The same under the density of `options`, with cells as large as relaxed ones there: the integral of the
/// square root of the density replaces the area. Errors: those of Session::cells.
Result<double> latticeEnergy(Session& session, const Sites& sites, CellsOptions options);

/// Number of sites that were given new places, by reason.
struct LostSites {
  std::uint64_t duplicates = 0, outside = 0, massless = 0;
  std::uint64_t hidden = 0;  ///< these stay: sites of larger weight hide them

  [[nodiscard]] bool moved() const { return duplicates + outside + massless > 0; }
  /// Returns a line for each kind.
  [[nodiscard]] std::vector<std::string> notes() const;
};

/// Where lost sites may go, and how much energy the cells beside which they go have.
class Seats {
 public:
  virtual ~Seats() = default;
  [[nodiscard]] virtual bool contain(Point place) const = 0;
  [[nodiscard]] virtual Point nearestTo(Point place) const = 0;
  /// The place that is so far from another, along two axes.
  [[nodiscard]] virtual Point beside(Point place, double right, double up) const = 0;
  /// Of a site without its weight.
  [[nodiscard]] virtual double energyOf(const Sites& sites, std::size_t i) const = 0;
};

/// Gives each lost site a place in `places`, which already holds the targets of all other sites. A duplicate
/// goes beside the site at its place. A site outside of the domain goes to the nearest place in it. A site
/// whose cell has no mass goes beside the site of a cell with much energy. None of this can add energy: a
/// lost site contributes none where it was, and another site to choose from makes no distance longer.
LostSites placeLostSites(const Sites& sites, const CellMoments& moments, const Seats& seats, Sites& places);

}  // namespace vorpipe::moving
