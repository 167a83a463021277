/// Polygons with holes as nested lists of points, as in GeoJSON and WKT.
#pragma once

#include "io/base/print.h"
#include "io/cells/cell_polygons.h"

namespace vorpipe {

/// Appends the rings of one polygon, each ending at its first point; `put(bytes, point)` appends a point.
template <class Put>
void printPolygon(Bytes& text, const ListText& list, const CellPolygons::Rings& polygon, const Put& put) {
  printList(text, list, polygon.size(), [&](Bytes& rings, std::size_t r) {
    const auto vertices = polygon[r];
    printList(rings, list, vertices.size() + 1,
              [&](Bytes& points, std::size_t k) { put(points, vertices[k % vertices.size()]); });
  });
}

/// Appends the polygons of a cell, one after the other.
template <class Put>
void printPolygons(Bytes& text, const ListText& list, const CellPolygons& cell, const Put& put) {
  printList(text, list, cell.size(),
            [&](Bytes& polygons, std::size_t p) { printPolygon(polygons, list, cell[p], put); });
}

}  // namespace vorpipe
