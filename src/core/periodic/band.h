/// How far beyond a periodic domain images of its sites are needed.
#pragma once

#include "core/periodic/images.h"

namespace vorpipe::core {

/// A band so wide that, for every place in the domain, an image beyond it is no nearer than the nearest
/// site or image within: all that a picture of the domain needs.
Band bandForPlaces(const PeriodicSites& placed, int threads);

/// What is likely to be enough for whole cells, which reach beyond the domain.
Band likelyBandForCells(const PeriodicSites& placed, int threads);

/// Makes the band of an axis as wide as is always enough where `width` is not much less.
double cappedBand(const PeriodicAxis& axis, double width);

/// Whether the band is as wide as is always enough along an axis.
inline bool isWhole(const Band& band, const PeriodicSites& placed, std::size_t a) {
  return !placed.axis[a].periodic || band.width[a] >= placed.axis[a].length;
}

}  // namespace vorpipe::core
