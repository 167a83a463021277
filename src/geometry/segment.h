/// Segments of discs: what lies between a chord and its arc.
#pragma once

namespace vorpipe::core {

struct SegmentMeasures {
  double area;
  double
      height;  ///< of the centroid above the chord, away from the disc's center; its distance from the chord
  double along, across;  ///< second moments about the centroid: along the chord, and across it
};

/// Of the segment whose arc is seen from the center under twice `half_angle`, which is 0 to pi; more than
/// half a disc has its center in it. Every digit is right to some 1e-15, for small angles too.
SegmentMeasures measureSegment(double radius, double half_angle);

}  // namespace vorpipe::core
