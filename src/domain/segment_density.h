/// A density of pixels along a segment.
#pragma once

#include "domain/density_pixels.h"

namespace vorpipe::core {

struct SegmentDensity {
  double mean = 0;     ///< its integral over the length
  double center = .5;  ///< how far from the beginning the center of mass is, as a part of the way
};

/// The integral over each pixel that the segment from a to b, in the caller's units, goes through. Where it
/// runs along the line between two pixels, it has the mean of both: masses have two one-sided derivatives
/// there. From b to a the mean is the same to the bit.
SegmentDensity densityAlong(const DensityPixels& pixels, Point a, Point b);

}  // namespace vorpipe::core
