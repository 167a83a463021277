/// Sites, and the domains in which they have cells.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vorpipe/result.h"

namespace vorpipe {

/// An axis-parallel rectangle; valid when finite and xmin < xmax, ymin < ymax.
struct Box {
  double xmin, ymin, xmax, ymax;
};

struct Point {
  double x, y;
  friend bool operator==(const Point&, const Point&) = default;
};

struct Point3 {
  double x, y, z;
  friend auto operator<=>(const Point3&, const Point3&) = default;
};

/// The smallest box around at least one point.
Box boxOf(std::span<const Point> points);

struct Sites;

/// The default domain of sites: the box of at least one site, grown on every side by 5 % of its longer side,
/// or by 0.5 if all sites are equal. It grows more where that would vanish beside the coordinates. It is not
/// finite if the sites extend too far.
Box domainOf(const Sites& sites);

/// A domain of any shape: polygons with holes, none of which cross or overlap. Ring r has the points
/// ring_offsets[r] .. ring_offsets[r + 1] - 1, the first of which is not repeated at its end; polygon p has
/// the rings polygon_offsets[p] .. polygon_offsets[p + 1] - 1: its outer ring, then its holes, each in either
/// direction. No points: there is no outline.
struct Outline {
  std::vector<Point> points;
  std::vector<std::uint64_t> ring_offsets, polygon_offsets;
  [[nodiscard]] bool empty() const { return points.empty(); }
};

/// The axes along which the domain repeats itself.
enum class Periodic : std::uint8_t { none, x, y, xy };

/// A density, constant in each pixel; laid out as Image. Finite and nonnegative.
struct Density {
  int width = 0, height = 0;
  std::vector<double> values;  ///< mass per unit of area; empty: there is no density
  /// The box of the pixels; beyond it the density is 0, and it does not repeat with the domain. None: they
  /// cover the domain.
  std::optional<Box> box{};
};

/// Sites in the caller's order. `weight` is empty or as long as x and y. The cell of site i is where |x -
/// p_i|^2 - w_i is least (a power diagram; also Laguerre, radical or weighted Voronoi diagram). Adding a
/// constant to all weights changes nothing; with equal weights it is the Voronoi diagram.
struct Sites {
  std::vector<double> x, y, weight;
  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// Marks a place that has no site.
inline constexpr std::uint32_t no_site = 0xFFFFFFFFu;

/// Returns the sites as a periodic domain uses them. Along the axes that repeat, a site beyond the domain is
/// moved into it by whole periods. Coordinates are rounded to about 2^-52 of the domain's side, or of its
/// largest coordinate if that is larger: then images are exact copies. Sites that are now equal, modulo the
/// period, are duplicates. Errors (input): no valid domain, no sites or sites that are not finite; a site
/// more than 2^50 periods away.
Result<Sites> wrapped(const Sites& sites, const Box& domain, Periodic periodic, int threads = 0);

/// What images of sites are needed for: pictures of the domain, or whole cells, which reach beyond it.
enum class ImagesFor : std::uint8_t { pictures, cells };

/// Number of sites and images together that the cells of a domain are computed from, for forecasts of memory.
/// It is slightly more than one per site for many even sites, and up to nine for few or very uneven ones. If
/// the first choice of images for cells turns out too small, more are added. Errors: those of wrapped().
Result<std::uint64_t> sitesAndImages(const Sites& sites, const Box& domain, Periodic periodic,
                                     ImagesFor purpose, int threads = 0);

/// Generators of sites in the unit square; the same seed gives the same sites on every platform.
enum class Pattern : std::uint8_t {
  random,    ///< white noise
  square,    ///< square lattice of floor(sqrt(n))^2 sites
  hex,       ///< hexagonal lattice of about n sites
  jitter,    ///< square lattice, each site moved at random inside its own square
  clusters,  ///< about 100 normal clusters of different sizes
  circle,    ///< evenly spaced on a circle of radius 0.4 about the center
};

/// Returns about n sites of a pattern (exactly n except for `square` and `hex`), n >= 1. Sites of the
/// patterns without randomness do not depend on seed.
Sites generate(Pattern pattern, std::uint64_t n, std::uint64_t seed);

/// Maps sites from the unit square to the smallest square around a box with the same center: a pattern keeps
/// its shape.
Sites spreadOver(const Box& box, Sites sites);

/// Maps sites from the unit square to degrees of the whole Earth: x to longitude, y to the sine of latitude,
/// so that equal areas remain equal.
Sites spreadOverGlobe(Sites sites);

}  // namespace vorpipe
