/// Sites along curves, on circles, in clusters: what data sets are made of.
#pragma once

#include "support/sites/random_sites.h"

namespace vorpipe::test {

/// 99 % of the sites in a hundredth of the domain.
Sites crowded(std::uint64_t n, Random& random);
Sites tightClusters(std::uint64_t n, Random& random);
/// Half of the sites spread over the domain, half in a square 1e-9 wide.
Sites dust(std::uint64_t n, Random& random);
Sites pairs(std::uint64_t n, Random& random);
Sites nearlyCollinear(std::uint64_t n, double noise, Random& random);
/// Exactly on a line: all of it is done in multiples of 2^-20.
Sites collinear(std::uint64_t n, int step_x, int step_y, Random& random);
/// Arcs of circles, a sine, a parabola and a straight line, the same number of sites on each.
Sites curves(std::uint64_t n, Random& random);
/// One arm of an Archimedean spiral in 20 turns, evenly along it.
Sites spiral(std::uint64_t n);
/// As the seeds of a sunflower: no two rows are alike, and all cells nearly.
Sites sunflower(std::uint64_t n);
/// All integer points of a circle about the origin, at most about n: exactly cocircular.
Sites pythagorean(std::uint64_t n, std::int64_t multiple);
Sites concentric(std::uint64_t n);
/// A tenth of the sites in a row, 1e-12 apart, and the others anywhere: cells a hundred billion times
/// longer than wide, whose short ends are ties, so that they have two edges.
Sites stripes(std::uint64_t n, Random& random);
/// On all four walls and corners of the unit square, evenly and not, and inside of it.
Sites onWalls(std::uint64_t n, Random& random);
/// Each site with its mirror images at x = 0.5 and y = 0.5: four cells meet at each crossing of an axis.
Sites mirrored(std::uint64_t n, Random& random);
/// Each site with its mirror image beyond a wall: the bisector is the wall.
Sites mirroredAtWalls(std::uint64_t n, Random& random);
Sites shuffled(Sites sites, Random& random);

/// Drill holes of a circuit board in mils: columns of equal steps, few distinct x (881 of 5000 sites).
Sites circuitBoard(std::uint64_t n, Random& random);

/// Places in decimal degrees with 4 to 6 digits, around towns of all sizes; a fifth are duplicates.
Sites zipCodes(std::uint64_t n, Random& random);

/// Degrees all over the world, dense on some continents, some rounded to minutes, some coincident.
Sites airports(std::uint64_t n, Random& random);

}  // namespace vorpipe::test
