/// The parts of check(); each adds its findings to Broken.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "check/nearest_site.h"
#include "check/places.h"
#include "check/run.h"

namespace vorpipe::core::checks {

/// Statuses and owners, of cells or of a picture.
struct Outcome {
  std::span<const Status> status;
  std::span<const std::uint32_t> owner;
  const Report& report;
};

/// Checks that each site has a status and an owner. The heaviest, then the lowest index owns a position; the
/// others are duplicates. A site in the domain is not empty unless it has a weight. The report's counts must
/// match. Returns false if the arrays are unusable.
bool checkOutcome(const CheckedSites& run, const Outcome& outcome, Broken& broken);

/// Checks the lengths of arrays, ascending offsets, and neighbors that are walls or sites with cells. The
/// other checks rely on it.
bool checkArrays(const CheckedCells& run, Broken& broken);

/// Checks that sites without a cell have no measures, and that areas add up to `domain`, the domain's, up to
/// the fraction `slack`.
void checkMeasures(const CheckedCells& run, double domain, double slack, Broken& broken);

/// Checks that masses lie between the least and the largest density times the area, with centers in the box
/// of the cell. Without an outline, their sum must be the density's mass. Does nothing without a density.
void checkMass(const CheckedCells& run, Broken& broken);

/// For each edge of a cell, the index of the same edge in the neighbor's list, or no_twin.
using Twins = std::vector<std::uint32_t>;
inline constexpr std::uint32_t no_twin = 0xFFFFFFFFu;
Twins findTwins(const CheckedCells& run);

/// Checks that neighbors name each other once, with the same ends and length. The next two rely on it.
bool checkSymmetry(const CheckedCells& run, const Twins& twins, Broken& broken);

/// Checks Euler's formula for the domain cut into cells, flat or rolled up where it is periodic. Does nothing
/// if the domain is so narrow that ties extend across it.
void checkPartition(const CheckedCells& run, const Twins& twins, Broken& broken);

/// Checks the Delaunay triangulation of all sites except duplicates: counter-clockwise triangles side by
/// side, no site beyond a side inside of the circle, a convex hull, and the number that Euler's formula
/// requires. With weights it is a regular triangulation, which has all sites with cells. A periodic domain
/// must have none.
void checkTriangles(const CheckedCells& run, Broken& broken);

/// Checks that polygons are closed, convex and counter-clockwise, on the bisectors and walls that neighbors
/// name, and that measures match the vertices.
void checkPolygons(const CheckedCells& run, Broken& broken);

/// Checks that no site is nearer to the centroid and vertices of a cell than its own. It samples 10,000
/// cells, or fewer within some seconds if most sites are about equally far.
void checkNearestInCells(const CheckedCells& run, const NearestSite& nearest, Random& random, Broken& broken);

/// The same, and checks that places of the domain lie in the cell of their nearest site: up to 20,000, or as
/// many as some seconds allow.
void checkNearest(const CheckedCells& run, const NearestSite& nearest, Broken& broken);

/// The broken promises of cells on the globe.
std::vector<std::string> brokenOnGlobe(const Sites& sites, const CellsOptions& options,
                                       const Diagram& diagram, int threads);

}  // namespace vorpipe::core::checks
