/// Cells of given masses: the weights of sites that give each cell its share (semi-discrete optimal
/// transport).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/moving.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"

namespace vorpipe {

struct TransportOptions {
  Box domain;
  Outline outline{};
  Periodic periodic = Periodic::none;
  Density density{};  ///< over the domain
  Surface surface = Surface::none;
  SearchOptions search;
  /// By site; each finite and positive. Their sum equals the mass of the domain, to 1e-9 of it; with a free
  /// surface it may be less. Empty: equal shares of the domain's mass, which a free surface does not allow.
  std::vector<double> masses{};
  double tolerance = 1e-8;       ///< ends when no cell differs from its mass by more than this fraction of it
  std::uint64_t diagrams = 400;  ///< maximum number
  Progress progress;             ///< may be empty
};

/// One diagram of a transport.
struct TransportStep {
  std::uint64_t diagram = 0, newton = 0;  ///< number of the diagram, and of the Newton step that it tries
  double length = 0;                      ///< fraction of the Newton step that was taken, up to 1
  bool taken = false;                     ///< the step was kept; else it is tried again at half the length
  double norm = 0;                        ///< root of the sum of squared differences; NaN: a cell was empty
  double worst = 0;                       ///< largest |mass - target| / target; NaN likewise
  double least = 0;                       ///< least mass / target; NaN likewise
  std::uint64_t linear_iterations = 0;    ///< of the system that gave the step
  double seconds = 0;                     ///< since the transport began
};

/// Why a transport ended.
enum class TransportEnd : std::uint8_t {
  converged,  ///< to the tolerance
  stagnated,  ///< at the limit of rounding
  diagrams,   ///< the maximum number was reached
  cancelled,
};

struct Transported {
  Sites sites;                       ///< with the weights found; their mean is 0, except with a free surface
  CellMoments cells;                 ///< of these weights; empty where progress stopped a diagram
  std::vector<TransportStep> trace;  ///< one entry for each diagram
  TransportEnd end = TransportEnd::converged;
  /// Integral of the squared distance to the site over all cells: the squared Wasserstein distance between
  /// the density and the sites' masses. 0 without `cells`.
  double cost = 0;
  Report report;
};

/// Called after each diagram; returning false ends the transport with the result so far.
using TransportWatcher = std::function<bool(const TransportStep&)>;

/// Finds the weights. It begins with the weights of the sites if these give each cell mass, else with weights
/// that do. Errors (input): those of Session::cells; impossible masses (Subject::masses); two sites at one
/// place.
Result<Transported> transport(Session& session, Sites sites, const TransportOptions& options,
                              const TransportWatcher& watcher = {});

}  // namespace vorpipe
