/// The cells that a device does not certify: from the triangulation of all sites if they are many, else from
/// the backend that finds them in double, then exactly.
#pragma once

#include <optional>

#include "backend/backend.h"
#include "core/delaunay/site_mesh.h"
#include "core/judge/neighbor_rows.h"

namespace vorpipe::core {

/// Gives the sites to the backend when it is first asked: most runs on even data never ask.
class Judge {
 public:
  /// `backend` takes in_double and exact, and nobody else gives it sites; both outlive this.
  Judge(Backend& backend, SiteMesh& mesh) : backend_(backend), mesh_(mesh), sites_(mesh.sites()) {}

  /// The cells of `which`, found with `effort`, in_double or exact: each comes out certified or empty. Either
  /// may mean from the mesh: in double once it is made, and where the cells are too many for anything else;
  /// exactly for that reason alone, so that cells of the mesh are found in another way. `exact` is increased
  /// by the number of cells that double did not decide. Errors: those of the backend; progress said stop.
  Result<NeighborRows> find(std::span<const std::uint32_t> which, Effort effort, int threads,
                            const Progress& progress, std::uint64_t& exact);

  /// The cells of `which` from the mesh, or nothing where there is none. All of them agree, in every tie.
  std::optional<NeighborRows> findInMesh(std::span<const std::uint32_t> which, int threads);

  /// See Backend::nearest.
  Result<void> nearest(const View& view, std::span<const std::uint32_t> pixels,
                       std::span<std::uint32_t> sites);

  /// Whether there is a mesh; it is made by that.
  [[nodiscard]] bool hasMesh() { return mesh_.isPossible() && mesh_.get() != nullptr; }

  /// Whether so many cells are worth the mesh: more of them cost next to nothing then.
  [[nodiscard]] bool areMany(std::size_t cells) const;

 private:
  /// Gives the backend the sites, unless it has them.
  Result<void> ready();

  /// Adds the cells of which[e] for e in `entries`; returns the entries that are still open.
  Result<std::vector<std::uint32_t>> findSome(std::span<const std::uint32_t> which,
                                              std::span<const std::uint32_t> entries, Effort effort,
                                              int threads, const Progress& progress, NeighborRows& cells);

  Backend& backend_;
  SiteMesh& mesh_;
  const SiteSet& sites_;
  bool ready_ = false;
};

}  // namespace vorpipe::core
