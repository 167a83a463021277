#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "base/block_sums.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "motion/equal_masses.h"
#include "motion/ground.h"
#include "motion/memory_order.h"
#include "motion/movable.h"
#include "motion/quasi_newton.h"
#include "vorpipe.h"
#include "vorpipe/stipple.h"

namespace vorpipe {

using namespace moving;

namespace {

/// Along a descent direction energy must fall by this part of what its slope predicts (Armijo).
constexpr double enough_fall = 1e-4;
/// Energies that differ by less than this part of their terms count as equal.
constexpr double energy_rounding = 1e-15;
/// Shorter steps are not tried.
constexpr double least_step = 0x1p-12;
/// Number of consecutive diagrams without a gain after which a relaxation ends.
constexpr int most_idle = 20;

CellsOptions cellsOptions(const RelaxOptions& options) {
  CellsOptions cells = cellsOf(options);
  if (options.equal_masses) cells.density = forEqualMasses(options.density);
  return cells;
}

/// Returns the number of diagrams reserved for making masses equal.
std::uint64_t lastDiagrams(const RelaxOptions& options) {
  constexpr std::uint64_t most = 12;
  const bool wanted = options.equal_masses && !options.density.values.empty();
  return wanted ? std::min(most, options.iterations / 4) : 0;
}

}  // namespace

struct Relaxation::State {
  State(Session& with, RelaxOptions from, Sites begin)
      : session(with),
        options(std::move(from)),
        ground(options.globe ? globeGround(session, options) : planeGround(session, cellsOptions(options))),
        threads(session.threads()),
        sites(std::move(begin)) {}

  Session& session;
  RelaxOptions options;
  std::unique_ptr<Ground> ground;
  int threads;
  Stopwatch watch{};

  std::vector<std::uint32_t> order{};  ///< of `sites`: see memoryOrder()
  Sites sites;                         ///< the result so far
  Sites callers{};                     ///< the same in the caller's order, updated on request
  bool callers_are_old = true;
  MeasuredSites at{};
  std::vector<RelaxStep> trace{};
  RelaxEnd end = RelaxEnd::iterations;
  bool ended = false;
  Report report{};
  std::string equal_note{};
  LostSites lost{};  ///< all sites that were given places so far

  QuasiNewton newton{threads};
  std::vector<double> direction{};
  double step = 0;        ///< of the next direction; 0: find a new direction
  bool steepest = false;  ///< the direction is that of Lloyd's step
  bool current = false;   ///< the moments are those of `sites`, not of a rejected step
  double least_energy = std::numeric_limits<double>::infinity(), least_way = least_energy;
  int idle = 0;

  Result<MeasuredSites> measure(const Sites& where);
  Result<bool> advance();
  Result<bool> moveLost();
  Result<bool> tryStep();
  Result<void> equalize();
  [[nodiscard]] double slope() const;
  void findDirection();
  void takeBack(std::size_t diagrams);
  void keep(Sites where, MeasuredSites measured);
  [[nodiscard]] Result<Sites> moved(double length) const {
    return ground->moved(sites, at, direction, length);
  }
  [[nodiscard]] bool isAtRest();
};

/// Computes the diagram of the sites `where`, and records it.
Result<MeasuredSites> Relaxation::State::measure(const Sites& where) {
  VORPIPE_VAR(measured, ground->measure(where));
  report = ground->report();
  RelaxStep step_done{trace.size()};
  step_done.energy = measured.energy;
  step_done.hexagonal = measured.hexagonal;
  step_done.farthest = measured.farthest / std::sqrt(measured.area / static_cast<double>(measured.cells));
  step_done.seconds = watch.seconds();
  trace.push_back(step_done);
  return measured;
}

void Relaxation::State::keep(Sites where, MeasuredSites measured) {
  sites = std::move(where);
  at = std::move(measured);
  current = true;
  callers_are_old = true;
}

/// Whether only rounding is left to gain: the sites last did not move, or for long neither energy nor the
/// remaining distances have decreased.
bool Relaxation::State::isAtRest() {
  if (at.farthest <= 4 * std::numeric_limits<double>::epsilon() * ground->reach()) return true;
  const bool falls = at.energy < least_energy - energy_rounding * 10 * at.scale;
  const bool nears = at.farthest < 0.9 * least_way;
  least_energy = falls ? at.energy : least_energy;
  least_way = nears ? at.farthest : least_way;
  idle = falls || nears ? 0 : idle + 1;
  return idle >= most_idle;
}

/// Returns the derivative of the energy along the direction.
double Relaxation::State::slope() const {
  return carefulSum(direction.size(), threads, [&](std::size_t k) { return at.gradient[k] * direction[k]; });
}

/// Finds the direction of the next step.
void Relaxation::State::findDirection() {
  step = 1;
  steepest = options.method == RelaxMethod::lloyd || newton.empty();
  if (!steepest) {
    newton.direction(at.gradient, at.inverse, direction);
    ground->bend(sites, at, direction);
    steepest = !(slope() < 0);
  }
  if (!steepest) return;
  newton.clear();
  direction = at.way;
}

/// Makes a Lloyd step that also gives places to sites with empty or massless cells.
Result<bool> Relaxation::State::moveLost() {
  direction = at.way;
  VORPIPE_VAR(where, moved(1));
  const LostSites now = ground->placeLost(sites, where);
  lost.hidden = now.hidden;
  if (!now.moved()) return false;
  VORPIPE_VAR(places, ground->placed(std::move(where)));
  VORPIPE_VAR(measured, measure(places));
  lost.duplicates += now.duplicates;
  lost.outside += now.outside;
  // Where there is little mass, the same sites recur.
  lost.massless = std::max(lost.massless, now.massless);
  keep(std::move(places), std::move(measured));
  newton.clear();
  step = 0;
  return true;
}

/// Computes one diagram of a line search. Returns whether a shorter step, or another direction, is left to
/// try.
Result<bool> Relaxation::State::tryStep() {
  if (step == 0) findDirection();
  VORPIPE_VAR(where, moved(step));
  VORPIPE_VAR(measured, measure(where));
  const bool lloyd = options.method == RelaxMethod::lloyd;
  const auto falls = [&] {
    return measured.energy <= at.energy + enough_fall * step * slope() + energy_rounding * at.scale;
  };
  if (lloyd || falls()) {
    if (!lloyd) {
      std::vector<double> way(direction.size()), change(direction.size());
      forAll(direction.size(), threads, [&](std::size_t k) {
        way[k] = step * direction[k];
        change[k] = measured.gradient[k] - at.gradient[k];
      });
      newton.add(std::move(way), std::move(change));
    }
    keep(std::move(where), std::move(measured));
    step = 0;
    return true;
  }
  trace.back().taken = false;
  current = false;
  step /= 2;
  if (step >= least_step) return true;
  step = 0;
  newton.clear();
  return !steepest;
}

Result<bool> Relaxation::State::advance() {
  const auto stop = [&](RelaxEnd why) {
    end = why;
    ended = true;
    return false;
  };
  const double spacing = std::sqrt(at.area / static_cast<double>(at.cells));
  if (options.tolerance > 0 && at.farthest <= options.tolerance * spacing && step == 0) {
    return stop(RelaxEnd::tolerance);
  }
  if (trace.size() > options.iterations - lastDiagrams(options)) return stop(RelaxEnd::iterations);
  Result<bool> more = false;
  if (step == 0 && at.has_lost && current) more = moveLost();
  if (more && !*more) {
    if (step == 0 && isAtRest()) return stop(RelaxEnd::stagnated);
    more = tryStep();
  }
  if (more) return *more ? true : stop(RelaxEnd::stagnated);
  if (more.error().code != ErrorCode::cancelled) return more;
  return stop(RelaxEnd::cancelled);
}

/// Makes masses equal at the end.
Result<void> Relaxation::State::equalize() {
  const std::uint64_t most = lastDiagrams(options);
  if (most < 2 || end == RelaxEnd::cancelled) return {};
  const CellsOptions plain = cellsOf(options);
  constexpr double tolerance = 0.01;
  auto equal = equalizeMasses(session, sites, plain, tolerance, most - 1);
  Result<MeasuredSites> measured = equal ? measure(equal->sites) : tl::unexpected(std::move(equal.error()));
  if (!measured && measured.error().code == ErrorCode::cancelled) {
    end = RelaxEnd::cancelled;
    return {};
  }
  if (!measured) return tl::unexpected(std::move(measured.error()));
  keep(std::move(equal->sites), std::move(*measured));
  if (equal->worst > tolerance) {
    equal_note = fmt::format(
        "masses differ by up to {:.2g} % of their mean after {} diagrams that made them "
        "equal; with more iterations there are more of these",
        100 * equal->worst, equal->diagrams);
  }
  return {};
}

const RelaxStep& lastTaken(const std::vector<RelaxStep>& trace) {
  // The first diagram, of the sites as they came, is always taken.
  return *std::find_if(trace.rbegin(), trace.rend(), [](const RelaxStep& step) { return step.taken; });
}

Relaxation::Relaxation() = default;
Relaxation::Relaxation(Relaxation&&) noexcept = default;
Relaxation& Relaxation::operator=(Relaxation&&) noexcept = default;
Relaxation::~Relaxation() = default;

Result<Relaxation> Relaxation::begin(Session& session, Sites sites, RelaxOptions options) {
  VORPIPE_TRY(checkTolerance(options.tolerance));
  VORPIPE_TRY(options.globe ? checkMovableOnGlobe(sites, options, session.threads())
                            : checkMovable(sites, cellsOptions(options), session.threads()));
  Relaxation relaxation;
  relaxation.state_ = std::make_unique<State>(session, std::move(options), std::move(sites));
  State& state = *relaxation.state_;
  // Along periodic axes places are rounded; sites that do not move keep the caller's places.
  const bool repeats = !state.options.globe && state.options.periodic != Periodic::none;
  Sites given = repeats ? state.sites : Sites{};
  VORPIPE_VAR(places, state.ground->placed(std::move(state.sites)));
  VORPIPE_TRY(state.ground->prepare(places));
  state.order = memoryOrder(places, state.ground->box());
  Sites ordered = inOrder(places, state.order);
  auto measured = state.measure(ordered);
  if (!measured && measured.error().code == ErrorCode::input) {
    // Errors must name the caller's sites by their numbers.
    VORPIPE_TRY(state.ground->measure(places));
  }
  if (!measured) return tl::unexpected(std::move(measured.error()));
  state.keep(std::move(ordered), std::move(*measured));
  state.callers = std::move(repeats ? given : places);
  state.callers_are_old = false;
  return relaxation;
}

/// Undoes a failed step: the next one begins anew, from the same sites.
void Relaxation::State::takeBack(std::size_t diagrams) {
  trace.resize(diagrams);
  newton.clear();
  step = 0;
  current = ended = false;
}

Result<bool> Relaxation::step() {
  State& state = *state_;
  if (state.ended) return false;
  const std::size_t diagrams = state.trace.size();
  Result<bool> more = false;
  try {
    more = state.advance();
    if (more && !*more) {
      if (auto equal = state.equalize(); !equal) more = tl::unexpected(std::move(equal.error()));
    }
  } catch (const std::bad_alloc&) {
    state.takeBack(diagrams);  // before the message, for which there may be no memory either
    return tl::unexpected(Error{ErrorCode::device, "out of memory; fewer sites would fit"});
  }
  if (!more) state.takeBack(diagrams);
  return more;
}

const Sites& Relaxation::sites() const {
  State& state = *state_;
  if (std::exchange(state.callers_are_old, false)) {
    state.callers.x = inCallersOrder(state.sites.x, state.order);
    state.callers.y = inCallersOrder(state.sites.y, state.order);
  }
  return state.callers;
}
const std::vector<RelaxStep>& Relaxation::trace() const { return state_->trace; }
RelaxEnd Relaxation::end() const { return state_->end; }

const Report& Relaxation::report() const {
  State& state = *state_;
  Report& report = state.report;
  report.notes = state.ground->report().notes;
  for (std::string& line : state.lost.notes()) report.notes.push_back(std::move(line));
  if (!state.equal_note.empty()) report.notes.push_back(state.equal_note);
  return report;
}

Result<Relaxed> relax(Session& session, Sites sites, const RelaxOptions& options,
                      const RelaxWatcher& watcher) {
  VORPIPE_VAR(relaxation, Relaxation::begin(session, std::move(sites), options));
  bool stopped = false;
  while (!stopped) {
    VORPIPE_LET(more, relaxation.step());
    if (!more) break;
    stopped = watcher && !watcher(relaxation);
  }
  return Relaxed{relaxation.sites(), relaxation.trace(), stopped ? RelaxEnd::cancelled : relaxation.end(),
                 relaxation.report()};
}

}  // namespace vorpipe
