/// Cells of sites that move: measured again and again, without what each call of Session::cells makes anew.
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

/// What moving a site asks of its cell, by site in input order. With a density, mass, centroid and spread are
/// those of its mass; else of the area.
struct CellMoments {
  std::vector<Status> status;
  std::vector<double> area;
  std::vector<double> mass;     ///< the area where there is no density
  std::vector<Point> centroid;  ///< the site itself where there is no cell, or no mass in it
  std::vector<double>
      spread;  ///< integral of the squared distance to the centroid: mass times length squared
};

/// Which cells meet, by site in input order: those of cell i stand at offsets[i] up to offsets[i + 1].
struct CellsThatMeet {
  std::vector<std::uint64_t> offsets;               ///< size: sites + 1
  std::vector<std::int64_t> neighbors;              ///< as Diagram::neighbors
  std::vector<std::array<std::int32_t, 2>> shifts;  ///< as Diagram::neighbor_shifts; empty if not periodic
};

/// How masses change with weights and places of sites: a number for each of CellsThatMeet::neighbors. With b
/// the middle of the edge between cells i and j, and c its coupling,
///
///     d mass_i / d weight_j = -c,    d mass_i / d p_j = 2 c (p_j - b),    d mass_i / d p_i = -2 c (p_i - b),
///
/// where the second and third are to be added up over neighbors, as d mass_i / d weight_i = sum of c + half
/// of `arc` is (Kitagawa, Merigot and Thibert 2019, theorem 1.1; de Goes et al. 2015, section 3).
struct EdgesOfCells {
  /// Integral of the density along the edge, which is its length where there is no density, over twice the
  /// distance between the two sites, or to the image that the cell meets; 0 at walls. Ties have no entry.
  std::vector<double> coupling;
  /// Center of mass of the edge, as seen from cell i where the domain is periodic; its middle where it has no
  /// mass.
  std::vector<Point> middle;
  /// By site, of a free surface: integral of the density along the part of the circle around the site that
  /// bounds its cell, over its radius; without a density that is the angle of this part, in radians. Empty
  /// where cells fill the domain.
  std::vector<double> arc;
};

/// What lies around cells.
enum class Surface : std::uint8_t {
  none,  ///< cells fill the domain
  free,  ///< air does, with a weight of 0 everywhere: of its power cell a site has what is at most the root
         ///< of its weight away, and nothing where its weight is 0 or less
};

/// The cells of as many sites as at first, in one domain, wherever they are by now. Every cell is certified,
/// as those of Session::cells. The session outlives this; what is returned is good until the next call.
class MovingCells {
 public:
  /// `options.detail` is not read: moments are measured, and neighbors where they are asked for.
  MovingCells(Session& session, CellsOptions options, Surface surface = Surface::none);
  MovingCells(MovingCells&&) noexcept;
  MovingCells& operator=(MovingCells&&) noexcept;
  ~MovingCells();

  /// Finds the cells of the sites where they are now. Errors: those of Session::cells; another number of
  /// sites than before (input).
  Result<void> update(const Sites& sites);

  /// The same, but where a site has no cell, or no mass in it, this may end without having measured anything.
  /// Whether each has one; if not, the next three functions are not to be called. Duplicates have none.
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
