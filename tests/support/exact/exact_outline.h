/// Cells clipped to an outline in exact arithmetic, by CGAL's numbers alone: what cells with outlines are
/// judged by.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/exact/exact_cells.h"

namespace vorpipe::test {

/// What a site has of the inside of an outline.
struct ClippedCell {
  double area = 0, perimeter = 0;
  double along = 0;              ///< how much of the outline bounds it
  std::size_t parts = 0;         ///< those that meet in points are apart
  std::vector<ExactEdge> edges;  ///< with other sites, in ascending order of these; the sum of several pieces
};

/// By site. An edge is what lies in the open inside: where a bisector runs along the outline there is none.
/// The outline is valid. Takes as long as sites times points of the outline.
std::vector<ClippedCell> clippedCells(const Sites& sites, const Outline& outline);

/// What is wrong with a diagram with polygons, a line each: statuses, areas, perimeters, parts, and lengths
/// of the edges with each neighbor and along the outline. Meant for inputs whose edges are all longer than
/// ties, or have no length.
std::vector<std::string> compareClipped(const Diagram& diagram, const std::vector<ClippedCell>& exact);

}  // namespace vorpipe::test
