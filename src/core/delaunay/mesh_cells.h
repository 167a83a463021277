/// Cells from the triangulation of all sites.
#pragma once

#include <span>

#include "core/delaunay/site_mesh.h"

namespace vorpipe::core {

/// The cells of the sites `which`, from a mesh of the set: entry e, certified or empty, is that of which[e].
///
/// The neighbors of a site in the mesh are the edges of its cell, and its triangles the vertices. Where the
/// domain ends is decided exactly as well, for a domain that is smaller by less than any number: what lies
/// on a wall is beyond it. So all cells agree, in every tie. Empty cells of sites with weights have the sites
/// that leave nothing of them.
CellNeighbors meshCells(const SiteSet& sites, const Mesh& mesh, std::span<const std::uint32_t> which,
                        int threads);

}  // namespace vorpipe::core
