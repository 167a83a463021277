/// The checks that check() is made of; each adds to Broken what it finds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "check/images.h"
#include "check/nearest_site.h"
#include "check/places.h"
#include "check/run.h"

namespace vorpipe::core::checks {

/// Statuses and owners, as cells and pictures have them.
struct Outcome {
  std::span<const Status> status;
  std::span<const std::uint32_t> owner;
  const Report& report;
};

/// A status and an owner for each site; the heaviest, then the lowest index owns a position, the others are
/// duplicates; a site in the domain is not empty unless it has a weight; the report counts what is there.
/// False if the arrays are unusable.
bool checkOutcome(const CheckedSites& run, const Outcome& outcome, Broken& broken);

/// Arrays as long as they should be, ascending offsets, neighbors that are walls or sites with cells. The
/// other checks rely on it.
bool checkArrays(const CheckedCells& run, Broken& broken);

/// Nothing where there is no cell; areas that add up to `domain`, the domain's, up to that part of it.
void checkMeasures(const CheckedCells& run, double domain, double slack, Broken& broken);

/// Masses between the least and the largest density times the area, their centers in the box of the cell, and
/// a sum that is the density's in a domain without an outline. Nothing without a density.
void checkMass(const CheckedCells& run, Broken& broken);

/// Where the neighbor across each edge of a cell has the same edge: the place in the neighbor's list, or
/// no_twin.
using Twins = std::vector<std::uint32_t>;
inline constexpr std::uint32_t no_twin = 0xFFFFFFFFu;
Twins findTwins(const CheckedCells& run);

/// Neighbors name each other once, with the same ends and length. The next two rely on it.
bool checkSymmetry(const CheckedCells& run, const Twins& twins, Broken& broken);

/// Euler's formula for the domain, flat or rolled up where it is periodic, cut into cells. Nothing where the
/// domain is so narrow that ties go all across it.
void checkPartition(const CheckedCells& run, const Twins& twins, Broken& broken);

/// A Delaunay triangulation of all sites but duplicates: counter-clockwise triangles side by side, no site
/// beyond a side inside of the circle, a convex hull, and as many as Euler's formula asks for. With
/// weights a regular triangulation, which has all sites with cells. None where the domain is periodic.
void checkTriangles(const CheckedCells& run, Broken& broken);

/// Closed, convex, counter-clockwise, on the bisectors and walls that neighbors name, with the measures
/// that the vertices give.
void checkPolygons(const CheckedCells& run, Broken& broken);

/// No site is nearer to the centroid of a cell, and to its vertices, than its own: of 10,000 cells, or as
/// many as some seconds are for where most sites are about as far.
void checkNearestInCells(const CheckedCells& run, const NearestSite& nearest, Random& random, Broken& broken);

/// That, and places of the domain lie in the cell of their nearest site: up to 20,000, or as many as some
/// seconds are for.
void checkNearest(const CheckedCells& run, const NearestSite& nearest, Broken& broken);

}  // namespace vorpipe::core::checks
