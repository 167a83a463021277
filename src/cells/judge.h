/// The cells that a device does not certify: from the triangulation of their sites and of those beside them,
/// where all others are known; else from that of all sites if they are many, or from the exact tier, in
/// double, then exactly.
#pragma once

#include <optional>

#include "backend/exact_tier.h"
#include "cells/neighbor_rows.h"
#include "cells/site_mesh.h"

namespace vorpipe::core {

/// Gives the sites to the exact tier when it is first asked: most runs on even data never ask.
class Judge {
 public:
  /// While this exists, no other caller may call exact.take(). `exact` and `mesh` outlive this.
  Judge(ExactTier& exact, SiteMesh& mesh) : exact_(exact), mesh_(mesh), sites_(mesh.sites()) {}

  /// The cells of `which`, beginning with `precision`: each comes out certified or empty. Either precision
  /// may mean from the mesh: in double once it is made, and where the cells are too many for anything else;
  /// exactly for that reason alone, so that cells of the mesh are found in another way. `exact` is increased
  /// by the number of cells that double did not decide. Error: progress said stop.
  Result<NeighborRows> find(std::span<const std::uint32_t> which, Precision precision, int threads,
                            const Progress& progress, std::uint64_t& exact);

  /// Adds the cells `which`, ascending, of a set all of whose other cells are in `rows`, certified or empty:
  /// from the triangulation of these sites and of those whose cells name one of them, or a wall. A neighbor
  /// of such a cell is one of them, or its cell names it; and a cell among fewer sites, if it has all its
  /// neighbors, is the cell. A site outside of the domain that has none in it is nowhere on a wall nearer
  /// than those whose cells are there. (With weights a hidden site may come out with a cell, which its
  /// neighbors then do not name.) The cells of a triangulation agree, in every tie. False, and `rows` is
  /// unchanged, where the sites cannot be triangulated, or lie on one line.
  bool findAmong(std::span<const std::uint32_t> which, int threads, NeighborRows& rows);

  /// See ExactTier::nearest.
  void nearest(const View& view, std::span<const std::uint32_t> pixels, std::span<std::uint32_t> sites);

  /// Whether there is a mesh; it is made by that.
  [[nodiscard]] bool hasMesh() { return mesh_.isPossible() && mesh_.get() != nullptr; }

  /// Whether finding `cells` cells one by one would take longer than triangulating all sites, whose mesh then
  /// has every other cell as well.
  [[nodiscard]] bool areMany(std::size_t cells) const;

 private:
  /// The exact tier, which has the sites.
  ExactTier& ready();

  /// Adds the cells of which[e] as cells e.
  void addFromMesh(const PartMesh& mesh, std::span<const std::uint32_t> which, int threads,
                   NeighborRows& cells) const;

  /// Adds the cells of which[e] for e in `entries`; returns the entries that are still open.
  Result<std::vector<std::uint32_t>> findSome(std::span<const std::uint32_t> which,
                                              std::span<const std::uint32_t> entries, Precision precision,
                                              const Progress& progress, NeighborRows& cells);

  ExactTier& exact_;
  SiteMesh& mesh_;
  const SiteSet& sites_;
  bool ready_ = false;
};

}  // namespace vorpipe::core
