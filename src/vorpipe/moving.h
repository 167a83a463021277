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

/// The cells of as many sites as at first, in one domain, wherever they are by now. Every cell is certified,
/// as those of Session::cells. The session outlives this; what is returned is good until the next call.
class MovingCells {
 public:
  /// `options.detail` is not read: moments are measured, and neighbors where they are asked for.
  MovingCells(Session& session, CellsOptions options);
  MovingCells(MovingCells&&) noexcept;
  MovingCells& operator=(MovingCells&&) noexcept;
  ~MovingCells();

  /// Finds the cells of the sites where they are now. Errors: those of Session::cells; another number of
  /// sites than before (input).
  Result<void> update(const Sites& sites);

  /// Of the last update that succeeded.
  [[nodiscard]] const CellMoments& moments() const;
  [[nodiscard]] const CellsThatMeet& neighbors() const;
  [[nodiscard]] const Report& report() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe
