#include "motion/prescribed_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/block_sums.h"
#include "base/refusal.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "motion/linear/laplacian_solver.h"
#include "motion/linear/mass_change.h"
#include "motion/start_weights.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// The difference of cell masses from the prescribed ones.
struct Misfit {
  double norm = 0;   ///< root of the sum of squared differences
  double worst = 0;  ///< largest |mass - target| / target
  double least = 0;  ///< least mass / target
};

namespace {

/// Old weights are used only if they leave every cell at least this part of its mass.
constexpr double least_of_old = 0.02;
/// Shorter parts of a Newton step are not tried.
constexpr double least_length = 0x1p-30;
/// Below this misfit, a Newton step that gains nothing is limited by rounding.
constexpr double near_rounding = 1e-6;

/// Fills `missing` with target - mass by site. If cells fill the domain, the targets are scaled to the sum of
/// the cells' masses, since no other sum can be reached. Rounding then affects only the cells where it arose.
Misfit misfitOf(const CellMoments& moments, std::span<const double> targets, Surface surface, int threads,
                std::vector<double>& missing) {
  const std::size_t count = targets.size();
  missing.resize(count);
  double scale = 1, mean = 0;
  if (surface == Surface::none) {
    const double sum = carefulSum(count, threads, [&](std::size_t i) { return moments.mass[i]; });
    scale = sum / carefulSum(count, threads, [&](std::size_t i) { return targets[i]; });
    const double gap =
        carefulSum(count, threads, [&](std::size_t i) { return scale * targets[i] - moments.mass[i]; });
    mean = gap / static_cast<double>(count);
  }
  struct Part {
    CarefulSum squares;
    double worst = 0, least = std::numeric_limits<double>::infinity();
  };
  const auto parts = byBlocks<Part>(count, threads, [&](std::size_t begin, std::size_t end) {
    Part part;
    for (auto i = begin; i < end; ++i) {
      const double target = scale * targets[i];
      missing[i] = target - moments.mass[i] - mean;
      part.squares.add(missing[i] * missing[i]);
      part.worst = std::max(part.worst, std::abs(missing[i]) / target);
      part.least = std::min(part.least, moments.mass[i] / target);
    }
    return part;
  });
  Part all;
  for (const Part& part : parts) {
    all.squares.add(part.squares.value());
    all.worst = std::max(all.worst, part.worst);
    all.least = std::min(all.least, part.least);
  }
  return {std::sqrt(all.squares.value()), all.worst, all.least};
}

/// The connected part of a graph of cells that lacks the most mass.
struct Deficit {
  std::vector<std::uint32_t> cells;  ///< empty where all cells are one part
  double deficit = 0;                ///< total of its cells
};

Deficit greatestDeficit(const Laplacian& matrix, std::span<const double> missing, int threads) {
  const SingularParts parts(matrix, threads);
  if (parts.count() < 2) return {};
  std::vector<CarefulSum> deficits(parts.count());
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const auto part = parts.partOf()[i];
    if (part < deficits.size()) deficits[part].add(missing[i]);
  }
  const auto most = std::ranges::max_element(deficits, {}, &CarefulSum::value);
  Deficit found{{}, most->value()};
  for (std::uint32_t i = 0; i < missing.size(); ++i) {
    if (parts.partOf()[i] == static_cast<std::size_t>(most - deficits.begin())) found.cells.push_back(i);
  }
  return found;
}

/// Returns the total mass that these cells lack.
double deficitOf(std::span<const std::uint32_t> cells, std::span<const double> missing) {
  CarefulSum sum;
  for (const auto i : cells) sum.add(missing[i]);
  return sum.value();
}

}  // namespace

struct PrescribedCells::State {
  State(Session& session, const CellsOptions& from, Surface around, std::vector<double> given)
      : threads(session.threads()),
        options(from),
        surface(around),
        masses(std::move(given)),
        cells(session, from, around) {}

  int threads;
  CellsOptions options;
  Surface surface;
  std::vector<double> masses;
  MovingCells cells;
  LaplacianSolver solver{threads};
  std::vector<TransportStep> trace{};

  // Of one solution:
  PrescribedLimits limits{};
  TransportWatcher watcher{};
  Stopwatch watch{};
  Misfit misfit{};                    ///< of the weights that are kept
  std::vector<double> kept{};         ///< weights
  std::vector<double> missing{};      ///< of the weights that are kept
  std::vector<double> now_missing{};  ///< of those that were tried last
  std::vector<double> way{};          ///< the Newton step
  Laplacian matrix{};
  bool current = false;  ///< the cells are those of the weights that are kept
  bool stopped = false;  ///< by the watcher

  Result<Misfit> measure(const Sites& sites, TransportStep step = {});
  Result<bool> beginWith(Sites& sites, std::vector<double> weights, double least);
  Result<bool> beginAnywhere(Sites& sites);
  Result<bool> begin(Sites& sites);
  void keep(const Sites& sites, const Misfit& now);
  Result<void> restore(Sites& sites);
  void report();
  Result<bool> joinParts(Sites& sites, double enough);
  Result<std::uint64_t> findWay(Sites& sites, double enough);
  Result<TransportEnd> iterate(Sites& sites);
  Result<bool> search(Sites& sites, std::uint64_t newton, double enough, double& length);
  [[nodiscard]] double firstLength() const;
  [[nodiscard]] bool mayMeasure() const { return trace.size() < limits.diagrams && !stopped; }
};

/// Computes one diagram and adds it to the trace. If a cell has no mass, the misfit is not a number.
Result<Misfit> PrescribedCells::State::measure(const Sites& sites, TransportStep step) {
  current = false;
  VORPIPE_LET(whole, cells.updateUnlessEmpty(sites));
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const Misfit now = whole ? misfitOf(cells.moments(), masses, surface, threads, now_missing)
                           : Misfit{unknown, unknown, unknown};
  step.diagram = trace.size();
  step.norm = now.norm;
  step.worst = now.worst;
  step.least = now.least;
  step.seconds = watch.seconds();
  trace.push_back(step);
  return now;
}

void PrescribedCells::State::keep(const Sites& sites, const Misfit& now) {
  misfit = now;
  kept = sites.weight;
  missing.swap(now_missing);
  current = true;
  trace.back().taken = true;
}

/// Measures the weights that are kept, after others were tried.
Result<void> PrescribedCells::State::restore(Sites& sites) {
  sites.weight = kept;
  VORPIPE_LET(now, measure(sites));
  keep(sites, now);
  return {};
}

/// Reports the last diagram to the watcher.
void PrescribedCells::State::report() {
  if (watcher && !watcher(trace.back())) stopped = true;
}

/// Returns whether these weights leave every cell at least that part of its mass. If so, keeps them.
Result<bool> PrescribedCells::State::beginWith(Sites& sites, std::vector<double> weights, double least) {
  sites.weight = std::move(weights);
  VORPIPE_LET(now, measure(sites));
  const bool enough = now.least >= least;
  if (enough) keep(sites, now);
  report();
  return enough;
}

/// Begins with weights that do not depend on those that the sites have.
Result<bool> PrescribedCells::State::beginAnywhere(Sites& sites) {
  constexpr double any = 0;
  const std::vector<double> equal(sites.size(), 0.0);
  std::vector<std::vector<double>> starts;
  if (surface == Surface::free) {
    starts.push_back(discWeights(masses));
    const double least = *std::ranges::min_element(starts.front());
    starts.emplace_back(sites.size(), least);
  } else if (options.periodic == Periodic::xy) {
    starts.push_back(equal);
  } else {
    starts = {equal, spreadWeights(sites, options.domain, options.periodic)};
    if (!fillDomain(sites, options.domain, options.periodic)) std::swap(starts[0], starts[1]);
  }
  Result<bool> begun = false;
  for (std::size_t k = 0; k < starts.size() && begun && !*begun && mayMeasure(); ++k) {
    if (surface == Surface::none) centerWeights(starts[k], threads);
    begun = beginWith(sites, std::move(starts[k]), any);
  }
  const bool everywhere = options.outline.empty() && options.density.values.empty();
  if (!begun || *begun || everywhere || !mayMeasure() || options.periodic == Periodic::xy) return begun;
  std::vector<double> inside = spreadWeights(sites, boxWithMass(options), options.periodic);
  centerWeights(inside, threads);
  return beginWith(sites, std::move(inside), any);
}

Result<bool> PrescribedCells::State::begin(Sites& sites) {
  if (sites.weight.size() == sites.size()) {
    auto begun = beginWith(sites, sites.weight, least_of_old);
    if (!begun || *begun) return begun;
  }
  return beginAnywhere(sites);
}

/// No Newton step moves mass between parts that no edge joins. This raises the weights of the part that lacks
/// most, until one of its cells reaches into another part. Returns whether that succeeded.
Result<bool> PrescribedCells::State::joinParts(Sites& sites, double enough) {
  massMatrix(cells.neighbors(), cells.edges(), threads, matrix);
  const bool may_be_parts = !options.outline.empty() || !options.density.values.empty();
  if (surface != Surface::none || !may_be_parts) return false;
  const Deficit part = greatestDeficit(matrix, missing, threads);
  const double total = carefulSum(masses.size(), threads, [&](std::size_t i) { return masses[i]; });
  const double mean = total / static_cast<double>(masses.size());
  if (part.cells.empty() || part.deficit <= limits.tolerance * mean) return false;
  const Box& box = options.domain;
  const double area = (box.xmax - box.xmin) * (box.ymax - box.ymin);
  double none = 0, too_much = std::numeric_limits<double>::infinity();
  for (double raise = area / static_cast<double>(sites.size()); mayMeasure();) {
    sites.weight = kept;
    for (const auto i : part.cells) sites.weight[i] += raise;
    centerWeights(sites.weight, threads);
    VORPIPE_LET(now, measure(sites));
    report();
    const bool whole = !std::isnan(now.norm);
    const double deficit = whole ? std::abs(deficitOf(part.cells, now_missing)) : part.deficit;
    // A reduction by this factor is not rounding.
    const bool moved = deficit < 0.999 * part.deficit;
    if (now.least >= enough && moved) {
      keep(sites, now);
      return true;
    }
    const bool nothing = whole && deficitOf(part.cells, now_missing) > 0 && !moved;
    (nothing ? none : too_much) = raise;
    const double next = std::isfinite(too_much) ? none + (too_much - none) / 2 : 2 * raise;
    if (next == raise || !std::isfinite(next)) break;
    raise = next;
  }
  return false;
}

/// Finds the Newton step from the weights that are kept; returns the iterations of the linear solver.
Result<std::uint64_t> PrescribedCells::State::findWay(Sites& sites, double enough) {
  Result<bool> joined = true;
  while (joined && *joined) joined = joinParts(sites, enough);
  if (!joined) return tl::unexpected(std::move(joined.error()));
  if (!current) {
    VORPIPE_TRY(restore(sites));
    massMatrix(cells.neighbors(), cells.edges(), threads, matrix);
  }
  // A system solved to a relative residual r leaves r of the misfit, where the step itself would leave its
  // square.
  constexpr double coarsest = 1e-3, finest = 1e-9;
  const double tolerance = std::clamp(0.1 * misfit.worst, finest, coarsest);
  VORPIPE_VAR(solved, solver.solve(matrix, missing, tolerance, way));
  return solved.iterations;
}

/// Takes the longest part of the step, halved each time, that leaves cells enough mass and reduces the misfit
/// (Kitagawa, Merigot and Thibert 2019, algorithm 1). Returns whether there was one.
Result<bool> PrescribedCells::State::search(Sites& sites, std::uint64_t newton, double enough,
                                            double& length) {
  VORPIPE_LET(iterations, findWay(sites, enough));
  while (length >= least_length && mayMeasure()) {
    forAll(sites.size(), threads, [&](std::size_t i) { sites.weight[i] = kept[i] + length * way[i]; });
    TransportStep step;
    step.newton = newton;
    step.length = length;
    step.linear_iterations = iterations;
    VORPIPE_LET(now, measure(sites, step));
    const bool taken = now.least >= enough && now.norm <= (1 - length / 2) * misfit.norm;
    if (taken) keep(sites, now);
    report();
    if (taken) return true;
    // Near the end a whole step is right; if it gains nothing, rounding is the cause.
    if (!std::isnan(now.norm) && length == 1 && misfit.worst < near_rounding) {
      if (now.worst < misfit.worst) keep(sites, now);
      return false;
    }
    length /= 2;
  }
  return false;
}

/// Returns the part of the first Newton step to try first: short if masses are far off.
double PrescribedCells::State::firstLength() const {
  const double sum = carefulSum(masses.size(), threads, [&](std::size_t i) { return masses[i] * masses[i]; });
  const double off = misfit.norm / std::sqrt(sum);
  return off > 1 ? 0x1p-5 : misfit.least < 0.1 ? 0.25 : 1;
}

Result<TransportEnd> PrescribedCells::State::iterate(Sites& sites) {
  const double enough = 0.5 * std::min(misfit.least, 1.0);
  double length = firstLength();
  for (std::uint64_t newton = 1; misfit.worst > limits.tolerance; ++newton) {
    if (stopped) return TransportEnd::cancelled;
    if (!mayMeasure()) return TransportEnd::diagrams;
    const double tried = length;
    VORPIPE_LET(stepped, search(sites, newton, enough, length));
    if (stepped) {
      // After a halving, doubling would only be undone at once.
      if (length == tried) length = std::min(1.0, 2 * length);
      continue;
    }
    if (misfit.worst <= limits.tolerance) break;
    if (stopped) return TransportEnd::cancelled;
    return mayMeasure() ? TransportEnd::stagnated : TransportEnd::diagrams;
  }
  return TransportEnd::converged;
}

PrescribedCells::PrescribedCells(Session& session, const CellsOptions& options, Surface surface,
                                 std::vector<double> masses)
    : state_(std::make_unique<State>(session, options, surface, std::move(masses))) {}
PrescribedCells::PrescribedCells(PrescribedCells&&) noexcept = default;
PrescribedCells& PrescribedCells::operator=(PrescribedCells&&) noexcept = default;
PrescribedCells::~PrescribedCells() = default;

Result<TransportEnd> PrescribedCells::solve(Sites& sites, const PrescribedLimits& limits,
                                            const TransportWatcher& watcher) {
  State& s = *state_;
  s.limits = limits;
  s.watcher = watcher;
  s.watch = {};
  s.trace.clear();
  s.stopped = s.current = false;
  VORPIPE_LET(begun, s.begin(sites));
  if (!begun && s.stopped) {
    return tl::unexpected(Error{ErrorCode::cancelled, "stopped before every cell had some of its mass"});
  }
  if (!begun) {
    return tl::unexpected(
        refusal(Subject::sites, "no weights to begin with were found that give each site a cell with mass"));
  }
  auto end = s.iterate(sites);
  if (!end && end.error().code == ErrorCode::cancelled) {
    sites.weight = s.kept;
    return TransportEnd::cancelled;
  }
  if (!end) return end;
  if (!s.current) {
    VORPIPE_TRY(s.restore(sites));
    s.report();
  }
  return end;
}

bool PrescribedCells::areMeasured() const { return state_->current; }
const MovingCells& PrescribedCells::cells() const { return state_->cells; }
const std::vector<TransportStep>& PrescribedCells::trace() const { return state_->trace; }

}  // namespace vorpipe::moving
