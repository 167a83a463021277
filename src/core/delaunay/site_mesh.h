/// The triangulation of all sites: the neighbors of every cell at once, by exact decisions.
#pragma once

#include <optional>

#include "backend/backend.h"
#include "core/delaunay/mesh.h"

namespace vorpipe::core {

/// Triangulates the sites of a set when it is first asked to, on one thread. The set outlives it.
class SiteMesh {
 public:
  SiteMesh(const SiteSet& sites, int threads) : sites_(sites), threads_(threads) {}

  [[nodiscard]] const SiteSet& sites() const { return sites_; }
  /// False where there are too many sites, or coordinates or weights are out of the range of predicates.h.
  /// True otherwise: then there is a mesh unless all sites are collinear.
  [[nodiscard]] bool isPossible();
  [[nodiscard]] bool isMade() const { return mesh_.has_value(); }

  /// The mesh, whose points are the sites by index in the set; or null.
  const Mesh* get();

 private:
  const SiteSet& sites_;
  int threads_;
  std::optional<bool> possible_;
  std::optional<Mesh> mesh_;  ///< empty where there is none
};

}  // namespace vorpipe::core
