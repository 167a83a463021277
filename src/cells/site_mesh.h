/// The triangulation of sites: the neighbors of every cell at once, by exact decisions.
#pragma once

#include <optional>

#include "backend/backend.h"
#include "geometry/mesh.h"
#include "vorpipe.h"

namespace vorpipe::core {

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

}  // namespace vorpipe::core
