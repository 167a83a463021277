/// The scenes, grouped by their difficulty.
#pragma once

#include "selftest/scene.h"

namespace vorpipe::selftests {

// even.cpp: typical sites
Scene patternScene(Pattern pattern, std::uint64_t sites, const Scale& scale);
Scene spiral(const Scale& scale);
/// Cells of hundreds of pixels, whose corners need accurate floats.
Scene fewSites(std::uint64_t sites, const Scale& scale);
Scene manySites(const Scale& scale);
/// Wider than any view.
Scene wideStrip(const Scale& scale);
Scene periodic(Periodic axes, const Scale& scale);
Scene ringOutline(const Scale& scale);

// weights.cpp
Scene randomWeights(const Scale& scale);
/// Weights |p|^2 of places near a lattice: all cells nearly meet in one point.
Scene liftedTwins(std::uint64_t sites, double noise, const Scale& scale);

// scales.cpp: coordinates that are very small, large or far away
Scene scaled(double factor, const Scale& scale);
Scene farAway(double distance, const Scale& scale);

// crowds.cpp: sites that are very near to each other
Scene crowds(double width, const Scale& scale);
Scene nearTwins(const Scale& scale);

// slivers.cpp: a small domain that cuts cells where they nearly meet
Scene circleInSmallDomain(const Scale& scale);
Scene latticeInSmallDomain(const Scale& scale);

}  // namespace vorpipe::selftests
