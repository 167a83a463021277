/// Cells of moving sites: measured repeatedly, without the setup of each call of Session::cells.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"

namespace vorpipe {

class Session;

/// The measures of a cell that moving its site needs, by site in input order. With a density, mass, centroid
/// and spread are those of its mass; else of the area.
struct CellMoments {
  std::vector<Status> status;
  std::vector<double> area;
  std::vector<double> mass;     ///< the area without a density
  std::vector<Point> centroid;  ///< the site itself if it has no cell, or no mass in it
  std::vector<double>
      spread;  ///< integral of the squared distance to the centroid: mass times length squared
};

/// Which cells meet, by site in input order: the neighbors of cell i are at offsets[i] up to offsets[i + 1].
struct CellsThatMeet {
  std::vector<std::uint64_t> offsets;               ///< size: sites + 1
  std::vector<std::int64_t> neighbors;              ///< as Diagram::neighbors
  std::vector<std::array<std::int32_t, 2>> shifts;  ///< as Diagram::neighbor_shifts; empty if not periodic
};

/// How masses change with weights and positions of sites: one number for each of CellsThatMeet::neighbors.
/// With b the middle of the edge between cells i and j, and c its coupling,
///
///     d mass_i / d weight_j = -c,    d mass_i / d p_j = 2 c (p_j - b),    d mass_i / d p_i = -2 c (p_i - b),
///
/// where the second and third are sums over neighbors, as is d mass_i / d weight_i = sum of c + half of `arc`
/// (Kitagawa, Merigot and Thibert 2019, theorem 1.1; de Goes et al. 2015, section 3).
struct EdgesOfCells {
  /// Integral of the density along the edge (without a density, its length) over twice the distance between
  /// the two sites, or to the image that the cell meets. 0 at walls. Ties have no entry.
  std::vector<double> coupling;
  /// Center of mass of the edge, as seen from cell i if the domain is periodic; its midpoint if it has no
  /// mass.
  std::vector<Point> middle;
  /// By site, for a free surface: integral of the density along the part of the circle around the site that
  /// bounds its cell, over its radius. Without a density this is the angle of that part, in radians. Empty
  /// where cells fill the domain.
  std::vector<double> arc;
};

/// What lies around cells.
enum class Surface : std::uint8_t {
  none,  ///< cells fill the domain
  free,  ///< air does, with a weight of 0 everywhere: a cell is the part of its power cell within the root of
         ///< its weight of the site; none if the weight is 0 or less
};

/// The cells of a fixed number of moving sites in one domain. Every cell is certified, as those of
/// Session::cells. The session outlives this object; returned references are valid until the next call.
class MovingCells {
 public:
  /// `options.detail` is ignored: moments are measured, and neighbors on request.
  MovingCells(Session& session, CellsOptions options, Surface surface = Surface::none);
  MovingCells(MovingCells&&) noexcept;
  MovingCells& operator=(MovingCells&&) noexcept;
  ~MovingCells();

  /// Finds the cells of the sites at their present positions. Errors: those of Session::cells; a different
  /// number of sites than before (input).
  Result<void> update(const Sites& sites);

  /// The same, but may end without measuring anything if a site has no cell, or no mass in it. Returns
  /// whether each site has one; if not, the next three functions must not be called. Duplicates have none.
  Result<bool> updateUnlessEmpty(const Sites& sites);

  /// Of the last update that succeeded.
  [[nodiscard]] const CellMoments& moments() const;
  [[nodiscard]] const CellsThatMeet& neighbors() const;
  [[nodiscard]] const EdgesOfCells& edges() const;
  [[nodiscard]] const Report& report() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe
