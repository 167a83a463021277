/// Cells into one kind of file each; the errors are those of writeCells().
#pragma once

#include "io/output_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// Columns site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors; neighbor_shifts
/// where the domain is periodic; rings where it has an outline; mass,mass_centroid_x,mass_centroid_y where it
/// has a density. The weight is 0 where sites have none; `vertices` and `rings` are numbers; neighbors are
/// separated by spaces, and so are shifts, each kx:ky.
Result<void> writeCsvCells(OutputFile& file, const Sites& sites, const Diagram& diagram);

/// Arrays of N sites, M vertices and T triangles: sites (N, 2), weights (N) where sites have them, status
/// uint8 (N) with 0 ok, 1 empty, 2 duplicate, owners uint32 (N), areas (N), perimeters (N), centroids
/// (N, 2), second_moments (N, 3), cell_offsets int64 (N + 1), cell_vertices (M, 2), neighbor_offsets int64
/// (N + 1), neighbors int64 (M), edge_lengths (M), triangles uint32 (T, 3); float64 where nothing is said.
/// Where a diagram has them: neighbor_shifts int32 (M, 2); ring_starts int64, one for each ring; mass (N) and
/// mass_centroids (N, 2).
Result<void> writeNpzCells(OutputFile& file, const Sites& sites, const Diagram& diagram);

/// FeatureCollection; a feature's id is its site, its properties are x, y, weight (where sites have one),
/// status, owner, area, perimeter, centroid and neighbors; mass, mass_centroid and neighbor_shifts where the
/// diagram has them. The geometry is a Polygon, of several pieces a MultiPolygon, or null.
Result<void> writeGeoJsonCells(OutputFile& file, const Sites& sites, const Diagram& diagram);

/// The longer side is 1000 pixels, the largest y is at the top; a site's hue follows from its index.
Result<void> writeSvgCells(OutputFile& file, const Diagram& diagram);

/// The faces stand in the order of their sites; z is 0. A piece of a cell is a face, one with holes several
/// triangles; where cells may have several faces, these stand in groups site_N.
Result<void> writeObjCells(OutputFile& file, const Diagram& diagram);

/// Binary, little-endian, z is 0; faces, as in .obj, have vertex_indices, site and
/// area, the whole cell's.
Result<void> writePlyCells(OutputFile& file, const Diagram& diagram);

/// Legacy format, version 3.0, binary, POLYDATA, z is 0; faces as in .obj; cell data are site, area,
/// perimeter, neighbors (their number) and status (as in .npz), the whole cell's.
Result<void> writeVtkCells(OutputFile& file, const Diagram& diagram);

/// Polygons begin and end at the same vertex.
Result<void> writeWktCells(OutputFile& file, const Diagram& diagram);

}  // namespace vorpipe
