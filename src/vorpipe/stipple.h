/// Sites that follow a density: their initial positions, and the density that they relax under.
#pragma once

#include <cstdint>

#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// Draws `count` random sites from a density over a domain: each part of it gets sites in proportion to its
/// mass. The pixels are taken in the order of Hilbert's curve, which keeps neighbors together. The mass along
/// the curve is cut into as many pieces of equal mass as there are sites, and each piece gets one site, at
/// random. The same seed gives the same sites on every platform, except that sites outside an outline are
/// drawn again. Errors (input): no density, an invalid one, or one without mass in the domain; a domain that
/// is no rectangle.
Result<Sites> drawnFrom(const Density& density, const Box& domain, const Outline& outline,
                        std::uint64_t count, std::uint64_t seed);

/// The same on the globe, in degrees: a density without a box of its own covers the Earth, and areas are
/// those on the sphere.
Result<Sites> drawnOnGlobe(Density density, std::uint64_t count, std::uint64_t seed);

/// Returns the density under which relaxed cells have equal masses of the given one. Many relaxed sites are
/// as dense as the square root of the density that they relax under (Gersho 1979). The result is therefore
/// the square of the values, relative to the greatest.
Density forEqualMasses(Density density);

}  // namespace vorpipe
