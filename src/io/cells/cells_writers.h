/// Writers of cells, one for each kind of file. Their errors are those of writeCells.
#pragma once

#include "io/base/geopackage.h"
#include "io/base/print.h"
#include "io/cells/cell_polygons.h"
#include "io/cells/cells_file.h"

namespace vorpipe {

/// Columns site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors; neighbor_shifts if
/// the domain is periodic; rings if it has an outline; mass,mass_centroid_x,mass_centroid_y if it has a
/// density; then the attributes. The weight is 0 if sites have none; `vertices` and `rings` are counts;
/// spaces separate neighbors, and shifts, each kx:ky.
Result<void> writeCsvCells(ByteSink& sink, const CellsOutput& output);

/// A FeatureCollection with a feature for each site: its id is the site, its properties are x, y, weight (if
/// sites have one), status, owner, area, perimeter, centroid and neighbors; mass, mass_centroid and
/// neighbor_shifts if the diagram has them; then the attributes. The geometry is a Polygon, a MultiPolygon
/// for several pieces, or null.
Result<void> writeGeojsonCells(ByteSink& sink, const CellsOutput& output);

/// The same features, each on a line of its own.
Result<void> writeGeojsonlCells(ByteSink& sink, const CellsOutput& output);

/// Polygons begin and end at the same vertex.
Result<void> writeWktCells(ByteSink& sink, const CellsOutput& output);

/// A GeoPackage with the layer `cells`, of MultiPolygons, NULL if there is no cell. Its fields are the
/// columns of .csv and `owner`; weight, mass and the like only if there are some.
Result<void> writeGpkgCells(ByteSink& sink, const CellsOutput& output);

/// Arrays of N sites, M vertices and T triangles: sites (N, 2), weights (N) if sites have them, status uint8
/// (N) with 0 ok, 1 empty, 2 duplicate, owners uint32 (N), areas (N), perimeters (N), centroids (N, 2),
/// second_moments (N, 3), cell_offsets int64 (N + 1), cell_vertices (M, 2), neighbor_offsets int64 (N + 1),
/// neighbors int64 (M), edge_lengths (M), triangles uint32 (T, 3); float64 unless stated. If a diagram has
/// them: neighbor_shifts int32 (M, 2); ring_starts int64, one for each ring; mass (N) and mass_centroids (N,
/// 2).
Result<void> writeNpzCells(ByteSink& sink, const CellsOutput& output);

/// The longer side is 1000 pixels, the largest y is at the top; a site's hue follows from its index.
Result<void> writeSvgCells(ByteSink& sink, const CellsOutput& output);

/// Writes faces in the order of their sites; z is 0. A piece of a cell is a face; one with holes is several
/// triangles. If cells may have several faces, groups site_N hold them.
Result<void> writeObjCells(ByteSink& sink, const CellsOutput& output);

/// Binary, little-endian, z is 0; faces, as in .obj, have vertex_indices, site and area, the whole cell's.
Result<void> writePlyCells(ByteSink& sink, const CellsOutput& output);

/// Legacy format, version 3.0, binary, POLYDATA, z is 0; faces as in .obj; cell data are site, area,
/// perimeter, neighbors (their number) and status (as in .npz), the whole cell's.
Result<void> writeVtkCells(ByteSink& sink, const CellsOutput& output);

/// PolyData, z is 0; faces as in .obj, with the whole cell's data.
Result<void> writeVtpCells(ByteSink& sink, const CellsOutput& output);

/// The same as an UnstructuredGrid.
Result<void> writeVtuCells(ByteSink& sink, const CellsOutput& output);

/// Makes polygons the geometry of a feature: a MultiPolygon.
void setPolygons(FeatureRow& row, Wkb& wkb, const CellPolygons& cell);

/// Appends the member "geometry" of a feature: a Polygon, a MultiPolygon for several, or null.
void printGeometry(Bytes& text, const CellPolygons& cell);

}  // namespace vorpipe
