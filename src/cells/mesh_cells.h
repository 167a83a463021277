/// Cells from a triangulation of sites.
#pragma once

#include <span>

#include "cells/site_mesh.h"

namespace vorpipe::core {

/// Entry e of `cells`, certified or empty, is the cell of site[e]; sites and neighbors by index in the set.
struct MeshCells {
  std::vector<std::uint32_t> site;
  CellNeighbors cells;
};

/// The cells of the mesh's sites that are wanted, by index in the set: each once, in parts of any size.
///
/// The neighbors of a site in the mesh are the edges of its cell, its triangles the vertices. Clipping to the
/// domain is exact as well, with the domain perturbed inward by an infinitesimal: what lies on a wall counts
/// as beyond it. So all cells of a mesh agree, in every tie. An empty cell of a site with weights has as
/// neighbors those sites that prove it empty.
std::vector<MeshCells> meshCells(const SiteSet& sites, const PartMesh& part,
                                 std::span<const std::uint8_t> is_wanted, int threads);

}  // namespace vorpipe::core
