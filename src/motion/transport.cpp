#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/block_sums.h"
#include "base/refusal.h"
#include "base/try.h"
#include "motion/memory_order.h"
#include "motion/movable.h"
#include "motion/prescribed_cells.h"
#include "motion/site_energy.h"
#include "motion/start_weights.h"
#include "vorpipe.h"
#include "vorpipe/masses.h"

namespace vorpipe {

using namespace moving;

namespace {

double sumOf(const std::vector<double>& values) {
  CarefulSum sum;
  for (const double value : values) sum.add(value);
  return sum.value();
}

/// Returns masses by site: those of the options, or equal shares of `whole`, the mass of the domain. Errors
/// (input, Subject::masses): the number of masses differs from that of sites; a mass is not finite or not
/// more than 0; the sum is not that of the domain, or, with a free surface, more than that.
Result<std::vector<double>> targetsOf(const TransportOptions& options, std::size_t sites, double whole) {
  const auto refuse = [](const std::string& what) {
    return tl::unexpected(refusalOf(Subject::masses, what));
  };
  const auto& masses = options.masses;
  if (masses.empty()) {
    if (options.surface == Surface::free) return refuse("a free surface needs them");
    return std::vector<double>(sites, whole / static_cast<double>(sites));
  }
  if (masses.size() != sites) {
    return refuse(fmt::format("there are {} for {} sites", masses.size(), sites));
  }
  const auto wrong =
      std::ranges::find_if_not(masses, [](double mass) { return std::isfinite(mass) && mass > 0; });
  if (wrong != masses.end()) {
    return refuse(fmt::format("that of site {} (counted from 0) is {}, not a finite number above 0",
                              wrong - masses.begin(), *wrong));
  }
  const double sum = sumOf(masses);
  constexpr double slack = 1e-9;
  const double excess = sum - whole;
  if (options.surface == Surface::free) {
    if (excess <= 0) return masses;
    return refuse(fmt::format("they add up to {}, more than the {} of the domain", sum, whole));
  }
  if (std::abs(excess) <= slack * whole) return masses;
  return refuse(fmt::format("they add up to {}, the mass of the domain to {}", sum, whole));
}

/// Number of diagrams of the density itself before levels are worth their cost, unless masses are about right
/// by then.
constexpr std::uint64_t patience = 50;
/// From here on Newton's method ends soon.
constexpr double about_right = 1;
/// Tolerance of a level that is followed by another one.
constexpr double level_tolerance = 0.3;

/// Returns the additions at each level, as parts of the density's mean. At the end the total addition has
/// less than half of the mean cell's mass, so that each cell keeps some mass without it.
std::vector<double> levelsFor(std::size_t sites) {
  std::vector<double> levels;
  for (double part = 1; part > 0.5 / static_cast<double>(sites); part /= 10) levels.push_back(part);
  return levels;
}

/// Joins the diagrams of several searches into one trace.
class JoinedTrace {
 public:
  JoinedTrace(const PrescribedLimits& limits, const TransportWatcher& watcher)
      : limits_(limits), watcher_(watcher) {}

  Result<TransportEnd> solve(PrescribedCells& cells, Sites& sites, double tolerance, std::uint64_t diagrams) {
    const TransportWatcher numbering = [&](const TransportStep& step) { return watcher_(numbered(step)); };
    auto end = cells.solve(sites, {tolerance, diagrams}, watcher_ ? numbering : TransportWatcher{});
    const std::size_t before = steps_.size();
    for (const TransportStep& step : cells.trace()) steps_.push_back(numbered(step));
    for (std::size_t k = before; k < steps_.size(); ++k) newton_ = std::max(newton_, steps_[k].newton);
    seconds_ = steps_.empty() ? 0 : steps_.back().seconds;
    diagrams_ = steps_.size();
    return end;
  }

  /// Number of diagrams left. A search whose last diagram was not taken measures the one before it again, in
  /// excess of the limit.
  [[nodiscard]] std::uint64_t left() const {
    return limits_.diagrams - std::min(diagrams_, limits_.diagrams);
  }
  [[nodiscard]] std::vector<TransportStep>& steps() { return steps_; }

 private:
  [[nodiscard]] TransportStep numbered(TransportStep step) const {
    step.diagram += diagrams_;
    if (step.newton > 0) step.newton += newton_;
    step.seconds += seconds_;
    return step;
  }

  const PrescribedLimits& limits_;
  const TransportWatcher& watcher_;
  std::vector<TransportStep> steps_{};
  std::uint64_t diagrams_ = 0, newton_ = 0;
  double seconds_ = 0;
};

double worstKept(const std::vector<TransportStep>& steps) {
  const auto last = std::find_if(steps.rbegin(), steps.rend(), [](const auto& step) { return step.taken; });
  return last == steps.rend() ? std::numeric_limits<double>::infinity() : last->worst;
}

/// Goes through all densities. Unless each of them reaches its masses, restores the weights that the sites
/// came with.
Result<TransportEnd> goThroughLevels(Session& session, const CellsOptions& options,
                                     const std::vector<double>& masses, Sites& sites, JoinedTrace& trace) {
  const std::vector<double> before = sites.weight;
  const auto first = static_cast<std::ptrdiff_t>(trace.steps().size());
  const auto& values = options.density.values;
  const double mean = sumOf(values) / static_cast<double>(values.size());
  Result<TransportEnd> end = TransportEnd::converged;
  for (const double part : levelsFor(sites.size())) {
    CellsOptions level = options;
    for (double& value : level.density.values) value += part * mean;
    PrescribedCells cells(session, level, Surface::none, masses);
    end = trace.solve(cells, sites, level_tolerance, trace.left());
    if (!end || *end != TransportEnd::converged) break;
    // At least one diagram is for the density itself.
    if (trace.left() > 0) continue;
    end = TransportEnd::diagrams;
    break;
  }
  if (end && *end == TransportEnd::converged) return end;
  sites.weight = before;
  std::for_each(trace.steps().begin() + first, trace.steps().end(), [](auto& step) { step.taken = false; });
  return end;
}

/// The state that Newton's method reached.
struct ReachedWeights {
  TransportEnd end = TransportEnd::converged;
  std::vector<TransportStep> trace{};  ///< of all densities
  PrescribedCells cells;               ///< as its solve() left them under `options`
};

/// Finds the weights of `sites` for these masses, as PrescribedCells::solve does. If the density is almost 0
/// in large parts of the domain, cells there would lose their mass and force short Newton steps. So if there
/// is no progress after some diagrams, this adds parts of the density's mean to it, ten times less at each
/// level. Each level begins with the weights of the one before (decision D118).
Result<ReachedWeights> reachWeights(Session& session, const CellsOptions& options, Surface surface,
                                    const std::vector<double>& masses, Sites& sites,
                                    const PrescribedLimits& limits, const TransportWatcher& watcher) {
  PrescribedCells cells(session, options, surface, masses);
  JoinedTrace trace(limits, watcher);
  const bool may_be_uneven = !options.density.values.empty() && surface == Surface::none;
  auto end = trace.solve(cells, sites, limits.tolerance,
                         may_be_uneven ? std::min(patience, limits.diagrams) : limits.diagrams);
  if (end && *end == TransportEnd::diagrams && trace.left() > 0) {
    if (worstKept(trace.steps()) > about_right) {
      end = goThroughLevels(session, options, masses, sites, trace);
    } else {
      end = TransportEnd::converged;
    }
    if (end && *end == TransportEnd::converged) {
      end = trace.solve(cells, sites, limits.tolerance, trace.left());
    }
  }
  if (!end) return tl::unexpected(std::move(end.error()));
  return ReachedWeights{*end, std::move(trace.steps()), std::move(cells)};
}

CellMoments momentsInCallersOrder(const CellMoments& cells, const std::vector<std::uint32_t>& order) {
  return {inCallersOrder(cells.status, order), inCallersOrder(cells.area, order),
          inCallersOrder(cells.mass, order), inCallersOrder(cells.centroid, order),
          inCallersOrder(cells.spread, order)};
}

}  // namespace

Result<double> massOfDomain(Session& session, const TransportOptions& options) {
  const Box& box = options.domain;
  CellsOptions cells = cellsOf(options);
  cells.search = {};
  cells.detail = Detail::measures;
  // The cell of a single site is the whole domain.
  const Sites site{{box.xmin + 0.5 * (box.xmax - box.xmin)}, {box.ymin + 0.5 * (box.ymax - box.ymin)}, {}};
  VORPIPE_LET(whole, session.cells(site, cells));
  return whole.mass.empty() ? whole.area[0] : whole.mass[0];
}

Result<void> fillDomain(Session& session, std::size_t sites, double part, TransportOptions& options) {
  VORPIPE_LET(whole, massOfDomain(session, options));
  auto& masses = options.masses;
  if (masses.empty()) masses.assign(sites, 1);
  if (masses.empty()) return {};
  if (!std::ranges::all_of(masses, [](double mass) { return std::isfinite(mass) && mass > 0; })) return {};
  // Divides by the greatest mass first: the sum of the given masses may overflow a double.
  const double greatest = *std::ranges::max_element(masses);
  const double sum =
      carefulSum(masses.size(), session.threads(), [&](std::size_t i) { return masses[i] / greatest; });
  for (double& mass : masses) mass = part * whole * (mass / greatest / sum);
  return {};
}

Result<Transported> transport(Session& session, Sites sites, const TransportOptions& options,
                              const TransportWatcher& watcher) {
  const CellsOptions cells = cellsOf(options);
  VORPIPE_TRY(checkTolerance(options.tolerance));
  VORPIPE_TRY(checkMovable(sites, cells, session.threads()));
  VORPIPE_VAR(places, options.periodic == Periodic::none
                          ? Result<Sites>(std::move(sites))
                          : wrapped(sites, options.domain, options.periodic, session.threads()));
  VORPIPE_TRY(checkPlaces(places, options.domain, options.periodic));
  VORPIPE_LET(whole, massOfDomain(session, options));
  VORPIPE_LET(targets, targetsOf(options, places.size(), whole));
  const auto order = memoryOrder(places, options.domain);
  Sites at = inOrder(places, order);
  if (options.surface == Surface::none && !at.weight.empty()) centerWeights(at.weight, session.threads());
  VORPIPE_VAR(reached, reachWeights(session, cells, options.surface, inOrder(targets, order), at,
                                    {options.tolerance, options.diagrams}, watcher));
  Transported done;
  done.end = reached.end;
  done.trace = std::move(reached.trace);
  done.report = reached.cells.cells().report();
  if (reached.cells.areMeasured()) {
    const CellMoments& moments = reached.cells.cells().moments();
    done.cost =
        carefulSum(at.size(), session.threads(), [&](std::size_t i) { return energyOf(at, moments, i); });
    done.cells = momentsInCallersOrder(moments, order);
  }
  // Along periodic axes places are rounded; sites keep the caller's places.
  done.sites = std::move(options.periodic == Periodic::none ? places : sites);
  done.sites.weight = inCallersOrder(at.weight, order);
  return done;
}

}  // namespace vorpipe
