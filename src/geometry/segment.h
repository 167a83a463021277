/// Segments of discs: what lies between a chord and its arc.
#pragma once

namespace vorpipe::core {

struct SegmentMeasures {
  double area;
  double
      height;  ///< of the centroid above the chord, away from the disc's center; its distance from the chord
  double along, across;  ///< second moments about the centroid: along the chord, and across it
};

/// Measures the segment whose arc subtends twice `half_angle` at the center; `half_angle` is 0 to pi. A
/// segment of more than half a disc contains the center. Accurate to some 1e-15, for small angles too.
SegmentMeasures measureSegment(double radius, double half_angle);

}  // namespace vorpipe::core
