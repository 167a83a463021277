/// Sites that follow a density: where they begin, and what they relax under.
#pragma once

#include <cstdint>

#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// Draws `count` sites from a density over a domain: as many to a part of it as it has of the mass. The
/// pixels are taken in the order of Hilbert's curve, which keeps neighbors together; what the curve passes is
/// cut into as many pieces of equal mass as there are sites, and each gets one, at random. The same seed
/// gives the same sites on every platform, but for what lies outside of an outline, where others are drawn.
/// Errors (input): no density, one that is none, or without mass in the domain; a domain that is no
/// rectangle.
Result<Sites> drawnFrom(const Density& density, const Box& domain, const Outline& outline,
                        std::uint64_t count, std::uint64_t seed);

/// The density under which relaxed cells have equal masses of this one. Where there are many of them, sites
/// are as dense as the square root of what they relax under (Gersho 1979), so that this is the square: of
/// values as parts of the greatest.
Density forEqualMasses(Density density);

}  // namespace vorpipe
