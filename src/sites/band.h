/// How far beyond a periodic domain images of its sites are needed.
#pragma once

#include "sites/images.h"

namespace vorpipe::core {

/// A band so wide that, for every point of the domain, no image beyond it is nearer than the nearest site or
/// image within: enough for a picture of the domain.
Band bandForPlaces(const PeriodicSites& placed, int threads);

/// What is likely to be enough for whole cells, which reach beyond the domain.
Band likelyBandForCells(const PeriodicSites& placed, int threads);

/// `width`, or a whole period, which is always enough, where `width` is not much less.
double cappedBand(const PeriodicAxis& axis, double width);

/// Whether the band along an axis is a whole period, which is always enough.
inline bool isWhole(const Band& band, const PeriodicSites& placed, std::size_t a) {
  return !placed.axis[a].periodic || band.width[a] >= placed.axis[a].length;
}

}  // namespace vorpipe::core
