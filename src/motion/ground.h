/// What sites move on while they relax: a domain of the plane, or the globe.
#pragma once

#include <memory>
#include <vector>

#include "motion/site_energy.h"
#include "vorpipe.h"

namespace vorpipe::moving {

class Ground : public Seats {
 public:
  /// Looks at the sites as they came, before their first diagram. Errors: those of Session::cells.
  virtual Result<void> prepare(const Sites& sites) = 0;

  /// Finds the cells of sites, and measures them. Errors: those of Session::cells.
  virtual Result<MeasuredSites> measure(const Sites& sites) = 0;

  /// Sites moved along a direction, as far as they may. Errors: those of placed().
  [[nodiscard]] virtual Result<Sites> moved(const Sites& sites, const MeasuredSites& at,
                                            const std::vector<double>& direction, double length) const = 0;

  /// Sites as placed in a domain that repeats itself. Errors: those of wrapped().
  [[nodiscard]] virtual Result<Sites> placed(Sites sites) const = 0;

  /// Bends a direction of the quasi-Newton method to one in which sites may move.
  virtual void bend(const Sites& sites, const MeasuredSites& at, std::vector<double>& direction) const = 0;

  /// Gives lost sites of the last measure() places among those of the others: see placeLostSites().
  [[nodiscard]] virtual LostSites placeLost(const Sites& sites, Sites& places) const = 0;

  /// A box around all places.
  [[nodiscard]] virtual Box box() const = 0;
  /// The largest coordinate of a place, in the unit of its steps.
  [[nodiscard]] virtual double reach() const = 0;
  /// Of the last measure().
  [[nodiscard]] virtual const Report& report() const = 0;
};

/// A domain of the plane. `cells` are the options of its cells. The session outlives it.
std::unique_ptr<Ground> planeGround(Session& session, CellsOptions cells);

/// The globe: RelaxOptions::globe. Steps are vectors in space, all x first, then all y, then all z.
std::unique_ptr<Ground> globeGround(const Session& session, const RelaxOptions& options);

/// Refuses what cannot move on the globe. Errors (input).
Result<void> checkMovableOnGlobe(const Sites& sites, const RelaxOptions& options, int threads);

}  // namespace vorpipe::moving
