/// A density of pixels along a segment.
#pragma once

#include "domain/density_pixels.h"

namespace vorpipe::core {

struct SegmentDensity {
  double mean = 0;     ///< its integral divided by the length
  double center = .5;  ///< position of the center of mass, as a fraction of the segment
};

/// Integrates the density over each pixel that the segment from a to b, in the caller's units, crosses. Along
/// the line between two pixels it takes the mean of both: masses have two one-sided derivatives there. From b
/// to a the mean is bitwise the same.
SegmentDensity densityAlong(const DensityPixels& pixels, Point a, Point b);

}  // namespace vorpipe::core
