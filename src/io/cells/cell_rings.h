/// Splits a cell into its polygons.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// A closed line of at least three vertices; the first is not repeated at its end.
struct Ring {
  std::uint64_t begin, end;  ///< in Diagram::vertices
  bool hole;
};

/// Returns the rings of the site's cell in the diagram's order: each outer ring, then its holes. None if the
/// cell has no polygon.
std::vector<Ring> ringsOf(const Diagram& diagram, std::size_t site);

/// Splits `rings` into polygons, each an outer ring and its holes.
std::vector<std::span<const Ring>> piecesOf(std::span<const Ring> rings);

/// Whether the site's cell has a polygon.
bool hasPolygon(const Diagram& diagram, std::size_t site);

inline std::span<const Point> verticesOf(const Diagram& diagram, const Ring& ring) {
  return std::span(diagram.vertices).subspan(ring.begin, ring.end - ring.begin);
}

}  // namespace vorpipe
