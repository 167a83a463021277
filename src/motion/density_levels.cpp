#include "motion/density_levels.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/block_sums.h"

namespace vorpipe::moving {
namespace {

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
  double part = 1;
  while (part > 0.5 / static_cast<double>(sites)) {
    levels.push_back(part);
    part /= 10;
  }
  return levels;
}

double meanOf(const std::vector<double>& values) {
  CarefulSum sum;
  for (const double value : values) sum.add(value);
  return sum.value() / static_cast<double>(values.size());
}

/// Joins the diagrams of several searches into one trace.
class JoinedTrace {
 public:
  JoinedTrace(const PrescribedLimits& limits, const TransportWatcher& watcher)
      : limits_(limits), watcher_(watcher) {}

  Result<TransportEnd> solve(PrescribedCells& cells, Sites& sites, double tolerance, std::uint64_t diagrams) {
    const TransportWatcher told = [&](const TransportStep& step) { return watcher_(numbered(step)); };
    auto end = cells.solve(sites, {tolerance, diagrams}, watcher_ ? told : TransportWatcher{});
    const std::size_t before = steps_.size();
    for (const TransportStep& step : cells.trace()) steps_.push_back(numbered(step));
    for (std::size_t k = before; k < steps_.size(); ++k) newton_ = std::max(newton_, steps_[k].newton);
    diagrams_ = steps_.size();
    seconds_ = steps_.empty() ? 0 : steps_.back().seconds;
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
  const double mean = meanOf(options.density.values);
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

}  // namespace

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

}  // namespace vorpipe::moving
