/// Cells from the triangulation of all sites.
#pragma once

#include <span>

#include "core/delaunay/site_mesh.h"

namespace vorpipe::core {

/// The cells of the sites `which`, from a mesh of the set: entry e, certified or empty, is that of which[e].
///
/// The neighbors of a site in the mesh are the edges of its cell, its triangles the vertices. Clipping to the
/// domain is exact as well, with the domain perturbed inward by an infinitesimal: what lies on a wall counts
/// as beyond it. So all cells agree, in every tie. An empty cell of a site with weights has as neighbors
/// those sites that prove it empty.
CellNeighbors meshCells(const SiteSet& sites, const Mesh& mesh, std::span<const std::uint32_t> which,
                        int threads);

}  // namespace vorpipe::core
