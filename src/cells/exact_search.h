/// Finds the cells that a device does not certify. If all other cells are known, triangulates their sites and
/// those beside them. Otherwise, if they are many, uses the triangulation of all sites; else the exact tier,
/// first in double, then exactly.
#pragma once

#include <optional>

#include "backend/exact_tier.h"
#include "cells/neighbor_rows.h"
#include "cells/site_mesh.h"

namespace vorpipe::core {

/// Gives the sites to the exact tier at the first request: most runs on even data never make one.
class ExactSearch {
 public:
  /// While this exists, no other caller may call exact.take(). `exact` and `mesh` outlive this.
  ExactSearch(ExactTier& exact, SiteMesh& mesh) : exact_(exact), mesh_(mesh), sites_(mesh.sites()) {}

  /// Finds the cells of `which`, beginning with `precision`; each comes out certified or empty. Either
  /// precision may use the mesh. In double, it does so once the mesh is made, or if the cells are too many
  /// for anything else. Exactly, it does so only for the latter reason, so that cells of the mesh are found
  /// in another way. `exact` is increased by the number of cells that double did not decide. Error: progress
  /// requested a stop.
  Result<NeighborRows> find(std::span<const std::uint32_t> which, Precision precision, int threads,
                            const Progress& progress, std::uint64_t& exact);

  /// Adds the cells `which`, ascending, to `rows`, which hold all other cells of the set, certified or empty.
  /// Triangulates these sites together with those whose cells name one of them, or a wall. A neighbor of such
  /// a cell is one of these sites, or its own cell names it. A cell among fewer sites is the true cell if
  /// these include all its neighbors. A site outside the domain without a cell in it is nowhere on a wall
  /// nearer than those whose cells are there. (With weights a hidden site may get a cell, which its neighbors
  /// then do not name.) The cells of a triangulation agree, in every tie. Returns false and leaves `rows`
  /// unchanged if the sites cannot be triangulated or lie on one line.
  bool findAmong(std::span<const std::uint32_t> which, int threads, NeighborRows& rows);

  /// See ExactTier::nearest.
  void nearest(const View& view, std::span<const std::uint32_t> pixels, std::span<std::uint32_t> sites);

  /// Whether there is a mesh; makes it if necessary.
  [[nodiscard]] bool hasMesh() { return mesh_.isPossible() && mesh_.get() != nullptr; }

  /// Whether finding `cells` cells one by one would take longer than triangulating all sites, whose mesh then
  /// has every other cell as well.
  [[nodiscard]] bool areMany(std::size_t cells) const;

 private:
  /// Returns the exact tier, after giving it the sites.
  ExactTier& ready();

  /// Adds the cells of which[e] as cells e.
  void addFromMesh(const PartMesh& mesh, std::span<const std::uint32_t> which, int threads,
                   NeighborRows& cells) const;

  /// Adds the cells of which[e] as cells e, without the mesh; returns the entries that are still open.
  Result<std::vector<std::uint32_t>> findAlone(std::span<const std::uint32_t> which, Precision precision,
                                               const Progress& progress, NeighborRows& cells);

  ExactTier& exact_;
  SiteMesh& mesh_;
  const SiteSet& sites_;
  bool ready_ = false;
};

}  // namespace vorpipe::core
