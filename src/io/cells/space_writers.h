/// Writers of cells in space, one for each kind of file. Their errors are those of writeSpaceCells.
#pragma once

#include "io/cells/space_file.h"

namespace vorpipe {

/// Arrays of N sites and F faces: sites (N, 3), weights (N) if sites have some, status uint8 (N) with 0 ok, 1
/// empty, 2 duplicate, owner uint32 (N), volumes (N), areas (N), those of surfaces, centroids (N, 3),
/// neighbor_offsets int64 (N + 1), neighbors int64 (F), face_areas (F), neighbor_shifts int32 (F, 3) of sites
/// that repeat; with polyhedra of V vertices second_moments (N, 6), face_vertex_offsets int64 (F + 1),
/// face_vertices uint32, vertices (V, 3), vertex_site_offsets int64 (V + 1), vertex_sites int64; float64
/// unless stated.
Result<void> writeSpaceNpz(ByteSink& sink, const SpaceOutput& output);

/// Columns site,x,y,z,weight,status,volume,area,centroid_x,centroid_y,centroid_z,faces,neighbors;
/// neighbor_shifts, kx:ky:kz, of sites that repeat; owner if there are duplicates; then the attributes.
/// Without weights they are 0; `faces` is a count; spaces separate neighbors.
Result<void> writeSpaceCsv(ByteSink& sink, const SpaceOutput& output);

/// An UnstructuredGrid of polyhedra (VTK_POLYHEDRON, 42) that share their points, with the arrays site,
/// volume, area, neighbors (their number), status and centroid; weight if sites have some.
Result<void> writeSpaceVtu(ByteSink& sink, const SpaceOutput& output);

/// An object cell_N for each polyhedron, with all of its faces.
Result<void> writeSpaceObj(ByteSink& sink, const SpaceOutput& output);

/// Binary, little-endian: each face once, and those between images in both cells, with vertex_indices, site,
/// neighbor (a wall is negative) and area.
Result<void> writeSpacePly(ByteSink& sink, const SpaceOutput& output);

/// Surfaces of the cells as triangles, binary: each face in both of its cells.
Result<void> writeSpaceStl(ByteSink& sink, const SpaceOutput& output);

/// A line for each polyhedron, in Voro++'s words: output.voro_format, else its usual one. Walls are Voro++'s
/// -1 to -6. Also (input): a radius is asked for, and weights are negative.
Result<void> writeSpaceVoro(ByteSink& sink, const SpaceOutput& output);

/// Replaces `corners` by the vertices of a cell, each once, ascending.
void takeCorners(const Diagram3& diagram, std::size_t site, std::vector<std::uint32_t>& corners);

/// Whether a site's cell has faces that enclose a polyhedron.
inline bool isPolyhedron(const Diagram3& diagram, std::size_t site) {
  constexpr std::uint64_t fewest = 4;
  return diagram.face_offsets[site + 1] - diagram.face_offsets[site] >= fewest;
}

/// The vertices around a face.
inline std::span<const std::uint32_t> ringOf(const Diagram3& diagram, std::size_t face) {
  const auto begin = diagram.face_vertex_offsets[face];
  return std::span(diagram.face_vertices).subspan(begin, diagram.face_vertex_offsets[face + 1] - begin);
}

}  // namespace vorpipe
