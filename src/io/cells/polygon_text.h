/// Polygons with holes as nested lists of points, as GeoJSON and WKT have them.
#pragma once

#include <span>

#include "io/meshes/cell_rings.h"
#include "io/text/print.h"

namespace vorpipe {

/// Appends the rings of one polygon, each of which ends where it began; `put(bytes, point)` appends a point.
template <class Put>
void printPolygon(Bytes& text, const ListText& list, const Diagram& diagram, std::span<const Ring> piece,
                  const Put& put) {
  printList(text, list, piece.size(), [&](Bytes& rings, std::size_t r) {
    const auto vertices = verticesOf(diagram, piece[r]);
    printList(rings, list, vertices.size() + 1,
              [&](Bytes& points, std::size_t k) { put(points, vertices[k % vertices.size()]); });
  });
}

/// Appends the polygons of a cell, one after the other.
template <class Put>
void printPolygons(Bytes& text, const ListText& list, const Diagram& diagram,
                   std::span<const std::span<const Ring>> pieces, const Put& put) {
  printList(text, list, pieces.size(),
            [&](Bytes& polygons, std::size_t p) { printPolygon(polygons, list, diagram, pieces[p], put); });
}

}  // namespace vorpipe
