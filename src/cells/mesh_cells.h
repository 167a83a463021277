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

/// Returns the cells of the mesh's wanted sites (`is_wanted`, by index in the set): each once, in parts of
/// any size.
///
/// A site's neighbors in the mesh give the edges of its cell, its triangles the vertices. Clipping to the
/// domain is exact as well. It perturbs the domain inward by an infinitesimal: a point on a wall counts as
/// beyond it. So all cells of a mesh agree, in every tie. The neighbors listed for an empty cell, with
/// weights, are the sites that prove it empty.
std::vector<MeshCells> meshCells(const SiteSet& sites, const PartMesh& part,
                                 std::span<const std::uint8_t> is_wanted, int threads);

}  // namespace vorpipe::core
