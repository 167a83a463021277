/// Relaxation: moves sites until each is the centroid of its cell (a centroidal Voronoi diagram).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/moving.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"

namespace vorpipe {

enum class RelaxMethod : std::uint8_t {
  lbfgs,  ///< quasi-Newton steps with memory 7, scaled by the masses of cells (Liu et al. 2009)
  lloyd,  ///< each site moves to its centroid (Lloyd 1982): the energy falls at every step
};

struct RelaxOptions {
  Box domain;
  Outline outline{};
  Periodic periodic = Periodic::none;
  Density density{};  ///< over the domain; sites concentrate where it is high
  /// Relaxes under the square of the density, so that cells get equal masses of it. In the last few diagrams
  /// sites move as little as equal masses require (to 1 %, where reachable).
  bool equal_masses = false;
  SearchOptions search;
  RelaxMethod method = RelaxMethod::lbfgs;
  std::uint64_t iterations = 50;  ///< maximum number of diagrams after the first
  double tolerance = 0;           ///< ends when no site would move by this fraction of the spacing; 0: never
  Progress progress;              ///< may be empty
  /// Sites are degrees of longitude and latitude, and move on the sphere (globe.md): domain, outline and
  /// period are not used. The density is read between the centers of its pixels, whose box is in degrees.
  /// Distances are straight through the unit sphere, areas in steradians. There are no equal masses.
  bool globe = false;
};

/// One diagram of a relaxation; number 0 is that of the initial sites.
struct RelaxStep {
  std::uint64_t diagram = 0;
  double energy = 0;  ///< sum over cells of the integral of |x - p|^2, less weight times mass
  double hexagonal =
      0;  ///< energy over that of the hexagonal lattice of as many cells (Gersho's with a density)
  double farthest = 0;  ///< largest distance from a site to its centroid, in spacings: sqrt(area / sites)
  double seconds = 0;   ///< since the relaxation began
  bool taken = true;  ///< false: the energy was too high, and the sites returned to their previous positions
};

/// The diagram of a trace's final sites: the last one that was taken.
const RelaxStep& lastTaken(const std::vector<RelaxStep>& trace);

/// Why a relaxation ended.
enum class RelaxEnd : std::uint8_t { iterations, tolerance, stagnated, cancelled };

/// A relaxation, step by step. The session outlives it.
class Relaxation {
 public:
  /// Computes the first diagram. Errors: those of Session::cells.
  static Result<Relaxation> begin(Session& session, Sites sites, RelaxOptions options);
  Relaxation(Relaxation&&) noexcept;
  Relaxation& operator=(Relaxation&&) noexcept;
  ~Relaxation();

  /// Moves the sites until the next diagram is computed; an accelerated step may compute several. Returns
  /// whether more remains to be done; if not, the sites stay as they are. Errors: those of Session::cells.
  Result<bool> step();

  [[nodiscard]] const Sites& sites() const;  ///< in input order; duplicates and empty sites stay
  [[nodiscard]] const std::vector<RelaxStep>& trace() const;  ///< one entry for each diagram
  [[nodiscard]] RelaxEnd end() const;                         ///< valid after step() returned false
  [[nodiscard]] const Report& report() const;                 ///< of the last diagram

 private:
  Relaxation();
  struct State;
  std::unique_ptr<State> state_;
};

struct Relaxed {
  Sites sites;
  std::vector<RelaxStep> trace;
  RelaxEnd end = RelaxEnd::iterations;
  Report report;
};

/// Called after each step with the relaxation; returning false ends it with its present sites.
using RelaxWatcher = std::function<bool(const Relaxation&)>;

/// Steps until nothing remains to be done. If progress or the watcher stops it, the sites of the last step
/// are the result, and `end` records that. Errors: those of Session::cells.
Result<Relaxed> relax(Session& session, Sites sites, const RelaxOptions& options,
                      const RelaxWatcher& watcher = {});

}  // namespace vorpipe
