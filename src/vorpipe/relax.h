/// Relaxation: sites that move until each is the centroid of its cell (a centroidal Voronoi diagram).
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
  Density density{};  ///< over the domain: sites gather where it is high
  /// Relaxes under the square of the density, so that cells get equal masses of it; with the last
  /// few diagrams sites move as little as makes masses equal (to 1 %, where that can be reached).
  bool equal_masses = false;
  SearchOptions search;
  RelaxMethod method = RelaxMethod::lbfgs;
  std::uint64_t iterations = 50;  ///< most diagrams that are computed after the first
  double tolerance = 0;           ///< ends when no site would move by this part of the spacing; 0: never
  Progress progress;              ///< may be empty
};

/// One diagram of a relaxation; number 0 is that of the sites as they came.
struct RelaxStep {
  std::uint64_t diagram = 0;
  double energy = 0;  ///< sum over cells of the integral of |x - p|^2, less weight times mass
  double hexagonal =
      0;  ///< energy over that of the hexagonal lattice of as many cells (Gersho's with a density)
  double farthest = 0;  ///< largest distance of a site to its centroid, in spacings: sqrt(area / sites)
  double seconds = 0;   ///< since the relaxation began
  bool taken = true;    ///< false: the energy was too high, and the sites went back to where they were before
};

/// The diagram of the sites as a trace leaves them: its last one that was taken.
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

  /// Moves the sites until the next diagram stands; one accelerated step may take several. Whether there is
  /// more to do; the sites stay as they are where there is not. Errors: those of Session::cells.
  Result<bool> step();

  [[nodiscard]] const Sites& sites() const;  ///< in input order; duplicates and empty sites stay
  [[nodiscard]] const std::vector<RelaxStep>& trace() const;  ///< one entry for each diagram
  [[nodiscard]] RelaxEnd end() const;          ///< after step() said that there is no more to do
  [[nodiscard]] const Report& report() const;  ///< of the last diagram

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

/// Called after each step with the sites as they are; returning false ends the relaxation with them.
using RelaxWatcher = std::function<bool(const Relaxation&)>;

/// Steps until nothing is left to do. Where progress or the watcher says stop, the sites of the last step are
/// the result, and `end` says so. Errors: those of Session::cells.
Result<Relaxed> relax(Session& session, Sites sites, const RelaxOptions& options,
                      const RelaxWatcher& watcher = {});

}  // namespace vorpipe
