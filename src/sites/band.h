/// How far beyond a periodic domain images of its sites are needed.
#pragma once

#include "sites/images.h"

namespace vorpipe::core {

/// Returns a band wide enough for a picture of the domain: for every point of the domain, no image beyond the
/// band is nearer than the nearest site or image within.
Band bandForPlaces(const PeriodicSites& placed, int threads);

/// Returns a band likely to be wide enough for whole cells, which reach beyond the domain.
Band likelyBandForCells(const PeriodicSites& placed, int threads);

/// Returns `width`, or, if it is not much less than a whole period, that period, which is always enough.
double cappedBand(const PeriodicAxis& axis, double width);

/// Whether the band along an axis is a whole period, which is always enough.
inline bool isWhole(const Band& band, const PeriodicSites& placed, std::size_t a) {
  return !placed.axis[a].periodic || band.width[a] >= placed.axis[a].length;
}

}  // namespace vorpipe::core
