/// The triangulation of sites: the neighbors of every cell at once, by exact decisions.
#pragma once

#include <optional>
#include <span>

#include "backend/backend.h"
#include "geometry/mesh.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// All sites of a set, ascending.
std::vector<std::uint32_t> allOf(const SiteSet& sites);

/// A triangulation of some sites of a set.
struct PartMesh {
  std::vector<std::uint32_t> site;  ///< by point of the mesh, along a curve: its index in the set
  std::vector<Point> points;
  std::vector<double> weights;  ///< empty, or by point
  Mesh mesh;                    ///< empty where all points lie on a line
};

/// Whether a set can be triangulated: its coordinates and weights are in the range of predicates.h, and there
/// are not too many.
bool canTriangulate(const SiteSet& sites);

/// Triangulates the sites `which`, in any order; canTriangulate must hold for the set.
PartMesh triangulate(const SiteSet& sites, std::vector<std::uint32_t> which, int threads);

/// Triangulates the sites of a set at the first request. The set outlives it.
class SiteMesh {
 public:
  SiteMesh(const SiteSet& sites, int threads) : sites_(sites), threads_(threads) {}

  [[nodiscard]] const SiteSet& sites() const { return sites_; }
  /// See canTriangulate. If true, there is a mesh unless all sites are collinear.
  [[nodiscard]] bool isPossible();
  [[nodiscard]] bool isMade() const { return mesh_.has_value(); }

  /// Returns the mesh of all sites, or null.
  const PartMesh* get();

 private:
  const SiteSet& sites_;
  int threads_;
  std::optional<bool> possible_;
  std::optional<PartMesh> mesh_;  ///< set at the first request; without triangles if `sites_` has no mesh
};

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
