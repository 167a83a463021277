#include "vorpipe/fluid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string_view>
#include <utility>

#include "base/block_sums.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "motion/flow.h"
#include "motion/movable.h"
#include "motion/softness.h"
#include "vorpipe.h"
#include "vorpipe/masses.h"

namespace vorpipe {

using namespace moving;

namespace {

/// Number of steps after which moved sites get a new order in memory.
constexpr std::uint64_t steps_of_order = 32;
/// A step whose areas cannot be found is halved, at most this many times.
constexpr int most_halvings = 6;

tl::unexpected<Error> refuse(std::string message) {
  return tl::unexpected(Error{ErrorCode::input, std::move(message)});
}

bool isPermutation(const std::vector<std::uint32_t>& order, std::size_t count) {
  if (order.size() != count) return false;
  std::vector<bool> seen(count);
  for (const std::uint32_t i : order) {
    if (i >= count || seen[i]) return false;
    seen[i] = true;
  }
  return true;
}

/// Energies are products of these values and must fit in a double.
constexpr double largest = 1e50;
bool isUsable(double value) { return std::abs(value) <= largest; }
bool isUsable(Point v) { return isUsable(v.x) && isUsable(v.y); }

tl::unexpected<Error> refuseRange(std::string_view what) {
  return refuse(fmt::format("{}: it is not finite, or beyond {:.0e}", what, largest));
}

Result<void> checkOptions(const FluidOptions& options) {
  if (!(options.step >= 0) || !std::isfinite(options.step)) return refuse("step: it is not 0 or more");
  if (options.epsilon != 0 && !(options.epsilon >= 1 / largest && options.epsilon <= largest)) {
    return refuse(fmt::format("epsilon: it is neither 0 nor from {:.0e} to {:.0e}", 1 / largest, largest));
  }
  if (!isUsable(options.gravity)) return refuseRange("gravity");
  if (std::isnan(options.until)) return refuse("until: it is not a number");
  VORPIPE_TRY(checkTolerance(options.tolerance));
  if (options.tolerance == 0) return refuse("tolerance: it is not more than 0");
  if (options.scheme == FluidScheme::projection && options.surface == Surface::free) {
    return refuse("scheme: projection is for domains that are full; springs have free surfaces");
  }
  if (!(options.viscosity >= 0 && options.viscosity <= largest)) {
    return refuse(fmt::format("viscosity: it is not from 0 to {:.0e}", largest));
  }
  if (!(options.centering >= 0 && options.centering <= largest)) {
    return refuse(fmt::format("centering: it is not from 0 to {:.0e}", largest));
  }
  if (options.walls == FluidWalls::slip) return {};
  if (options.viscosity == 0) return refuse("walls: without viscosity a fluid does not stick to them");
  if (options.surface == Surface::free) return refuse("walls: a fluid with a free surface slides along them");
  return {};
}

/// Checks that the volumes add up to the domain's area, or with a free surface to no more.
Result<void> checkVolumes(Surface surface, const std::vector<double>& volume, double area) {
  constexpr double slack = 1e-9;
  CarefulSum sum;
  for (const double part : volume) sum.add(part);
  const double excess = sum.value() - area;
  if (surface == Surface::free ? excess <= slack * area : std::abs(excess) <= slack * area) return {};
  return refuse(
      fmt::format("volume: they add up to {}, and the area of the domain is {}", sum.value(), area));
}

/// Refuses sites outside of the outline, but for those that rounding may have brought there.
Result<void> checkInside(const FluidOptions& options, const FluidState& state) {
  if (options.outline.empty()) return {};
  const AllowedPlaces allowed(options.domain, options.outline, options.periodic);
  const Box& box = options.domain;
  const double rounding = 1e-8 * std::max(box.xmax - box.xmin, box.ymax - box.ymin);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < state.sites.size(); ++i) {
    const Point at{state.sites.x[i], state.sites.y[i]};
    const Point inside = allowed.nearestTo(at);
    if (std::hypot(inside.x - at.x, inside.y - at.y) > rounding) ++outside;
  }
  if (outside == 0) return {};
  return refuse(fmt::format("sites: {} of {} lie outside of the outline", outside, state.sites.size()));
}

/// Refuses arrays that do not match these sites, and fills in those that may be left out.
Result<void> completeState(Session& session, const FluidOptions& options, FluidState& state) {
  const std::size_t count = state.sites.size();
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  const auto fits = [&](std::size_t size) { return size == count || size == 0; };
  if (!fits(state.velocity.size())) return refuse("velocity: there is not one for each site");
  if (!fits(state.volume.size())) return refuse("volume: there is not one for each site");
  if (!fits(state.density.size())) return refuse("density: there is not one for each site");
  if (!fits(state.pressure.size())) return refuse("pressure: there is not one for each site");
  if (!fits(state.trend.size())) return refuse("trend: there is not one for each site");
  if (!state.order.empty() && !isPermutation(state.order, count)) {
    return refuse("order: it does not name each site once");
  }
  const auto usable = [](const auto& value) { return isUsable(value); };
  if (!std::ranges::all_of(state.velocity, usable)) return refuseRange("velocity");
  if (!std::ranges::all_of(state.volume, positive)) return refuse("volume: it is not more than 0");
  if (!std::ranges::all_of(state.density, positive)) return refuse("density: it is not more than 0");
  if (!std::ranges::all_of(state.density, usable)) return refuseRange("density");
  if (!std::ranges::all_of(state.pressure, usable)) return refuseRange("pressure");
  state.velocity.resize(count, Point{0, 0});
  TransportOptions whole{};
  whole.domain = options.domain;
  whole.outline = options.outline;
  VORPIPE_LET(area, massOfDomain(session, whole));
  if (!state.volume.empty()) return checkVolumes(options.surface, state.volume, area);
  if (options.surface == Surface::free) return refuse("volume: a free surface asks for one of each site");
  state.volume.assign(count, area / static_cast<double>(count));
  return {};
}

/// Refuses two parcels at one place, which cannot be distinguished.
Result<void> checkDistinct(const Sites& sites, const FluidOptions& options, int threads) {
  if (options.periodic == Periodic::none) return checkPlaces(sites, options.domain, options.periodic);
  VORPIPE_LET(inside, wrapped(sites, options.domain, options.periodic, threads));
  return checkPlaces(inside, options.domain, options.periodic);
}

}  // namespace

struct Fluid::State {
  State(Session& from, FluidOptions how, FluidState begin)
      : session(from),
        options(std::move(how)),
        callers(std::move(begin)),
        now(parcelsOf(callers, options.domain)),
        flow(std::make_unique<Flow>(session, options, now)) {}

  Session& session;
  FluidOptions options;
  FluidState callers;  ///< in the caller's order, updated on request
  bool callers_are_old = false;
  Parcels now;
  std::unique_ptr<Flow> flow;
  Stopwatch watch{};
  FluidStep last{};
  FluidEnd end = FluidEnd::none;
  Report report{};                   ///< as returned to the caller
  std::vector<std::string> notes{};  ///< of the fluid
  double highest = 0;                ///< an upper bound of the flow's energy
  bool has_exploded = false, is_outgrown = false;
  bool is_pushed = false;  ///< since the last step

  bool is_torn = false;  ///< a step failed: the cells may not be those of the parcels

  void update();
  Result<bool> placeAnew();
  Result<bool> reorder();
  Result<void> placeAgain();
  Result<bool> attempt(double length, int halvings, FluidStep& step);
  Result<bool> move(double length, FluidStep& step);
  Result<bool> advance();
  void judgeFrom(const FluidStep& step);
  void judge(const FluidStep& step);
};

/// Bounds the energy by its present value plus all energy that can still turn into motion. Rounding and
/// slightly too long steps add less than that.
void Fluid::State::judgeFrom(const FluidStep& step) {
  update();
  const std::vector<double> fall = fallOf(callers, options);
  double movable = step.kinetic + step.spring;
  for (std::size_t i = 0; i < fall.size(); ++i) {
    const double density = callers.density.empty() ? 1 : callers.density[i];
    movable += density * callers.volume[i] * std::max(0.0, fall[i]);
  }
  highest = movable > 0 ? step.energy() + movable : std::numeric_limits<double>::infinity();
}

/// Notes, once each, that energy has come out of nothing, or that speeds are too large for the springs.
void Fluid::State::judge(const FluidStep& step) {
  if (std::exchange(is_pushed, false)) judgeFrom(step);
  if (!has_exploded && !(step.energy() <= highest)) {
    has_exploded = true;
    notes.push_back(
        fmt::format("energy has grown to {:.3g} at time {:.3g}, out of nothing: steps are too long",
                    step.energy(), step.time));
  }
  if (has_exploded || is_outgrown || options.scheme != FluidScheme::springs) return;
  // A slow fluid may fall later.
  const double spacing = meanSpacing(callers.volume);
  if (!areTooSoft(options.epsilon, step.fastest, spacing, options.surface)) return;
  is_outgrown = true;
  notes.push_back(fmt::format("{}, at time {:.3g}",
                              unfitFor(options.epsilon, step.fastest, spacing, options.surface), step.time));
}

/// Brings the caller's state up to date.
void Fluid::State::update() {
  if (!callers_are_old) return;
  backFrom(now, callers);
  callers_are_old = false;
}

/// Finds the cells of the caller's state.
Result<bool> Fluid::State::placeAnew() {
  now = parcelsOf(callers, options.domain);
  flow = std::make_unique<Flow>(session, options, now);
  return flow->place(now);
}

/// Restores the memory order, since neighbors drift apart. Accelerations do not change: they follow the
/// parcels.
Result<bool> Fluid::State::reorder() {
  update();
  callers.order.clear();
  const auto placed = placeAnew();
  callers.order = now.order;
  return placed;
}

/// Finds the cells again, since a failed step may have left cells that are not those of its beginning.
Result<void> Fluid::State::placeAgain() {
  update();
  VORPIPE_LET(placed, placeAnew());
  if (!placed) return refuse("volume: areas of the cells could not be found");
  is_torn = false;
  return {};
}

/// Makes a step, or two of half its length if areas cannot be found, and so on.
Result<bool> Fluid::State::attempt(double length, int halvings, FluidStep& step) {
  const Parcels before = now;
  auto done = flow->advance(now, length);
  flow->count(step);
  // The sites were valid before the step, so such an error means that the step led them too far.
  if (!done && done.error().code == ErrorCode::input) done = false;
  if (done && *done) return done;
  now = before;
  if (!done || halvings == 0) return done;
  ++step.halvings;
  for (int half = 0; half < 2; ++half) {
    done = attempt(length / 2, halvings - 1, step);
    if (!done || !*done) return done;
  }
  return done;
}

/// Makes a step and measures it; returns whether it was made.
Result<bool> Fluid::State::move(double length, FluidStep& step) {
  if (callers.step > 0 && callers.step % steps_of_order == 0) {
    if (auto ordered = reorder(); !ordered || !*ordered) return ordered;
  }
  auto done = attempt(length, most_halvings, step);
  if (done && *done) flow->measure(now, step);
  return done;
}

/// A step that fails, as for lack of memory, does not count: the next one begins where it did.
Result<bool> Fluid::State::advance() {
  if (end != FluidEnd::none) return false;
  if (is_torn) {
    VORPIPE_TRY(placeAgain());
  }
  FluidStep step{};
  step.step = callers.step + 1;
  const double left = options.until - callers.time;
  double length = flow->length(now);
  // The time left after the last whole step may be only rounding.
  constexpr double rounding = 1e-9;
  if (!(left > rounding * length)) {
    end = FluidEnd::time;
    return false;
  }
  const bool is_last = left <= length * (1 + rounding);
  if (is_last) length = left;
  if (!(callers.time + length > callers.time)) {
    return refuse(fmt::format("step: one of {} is nothing beside the time, {}", length, callers.time));
  }
  // Diagrams of few sites finish before they call progress.
  if (options.progress && !options.progress("step", 0)) {
    end = FluidEnd::cancelled;
    return false;
  }
  step.time = is_last ? options.until : callers.time + length;
  step.length = length;
  Parcels before = now;
  Result<bool> done = false;
  bool had_memory = true;
  try {
    done = move(length, step);
  } catch (const std::bad_alloc&) {
    had_memory = false;
  }
  if (had_memory && done && *done) {
    callers_are_old = true;
    callers.step = step.step;
    callers.time = step.time;
    step.seconds = watch.seconds();
    last = step;
    judge(step);
    return true;
  }
  now = std::move(before);
  callers.order = now.order;
  if (had_memory && (done || done.error().code == ErrorCode::cancelled)) {
    end = done ? FluidEnd::areas : FluidEnd::cancelled;
    return false;
  }
  is_torn = true;
  if (had_memory) return done;
  return tl::unexpected(Error{ErrorCode::device, "out of memory; fewer sites would fit"});
}

Fluid::Fluid() = default;
Fluid::Fluid(Fluid&&) noexcept = default;
Fluid& Fluid::operator=(Fluid&&) noexcept = default;
Fluid::~Fluid() = default;

FluidScheme schemeOf(const FluidOptions& options) {
  if (options.scheme != FluidScheme::automatic) return options.scheme;
  return options.surface == Surface::none ? FluidScheme::projection : FluidScheme::springs;
}

Result<Fluid> Fluid::begin(Session& session, FluidState state, FluidOptions options) {
  if (options.epsilon == 0) options.epsilon = state.epsilon;
  options.scheme = schemeOf(options);
  VORPIPE_TRY(checkOptions(options));
  VORPIPE_TRY(checkMovable(state.sites, cellsOf(options), session.threads()));
  VORPIPE_TRY(checkInside(options, state));
  VORPIPE_TRY(completeState(session, options, state));
  VORPIPE_TRY(checkDistinct(state.sites, options, session.threads()));
  const bool is_chosen = options.epsilon == 0;
  if (is_chosen) options.epsilon = usualEpsilon(state, options);
  state.epsilon = options.epsilon;
  auto notes = notesBefore(state, options, is_chosen);
  Fluid fluid;
  fluid.state_ = std::make_unique<State>(session, std::move(options), std::move(state));
  State& s = *fluid.state_;
  s.notes = std::move(notes);
  // The first notes already report springs that are too soft from the beginning.
  s.is_outgrown = areTooSoft(s.options.epsilon, usualSpeed(s.callers, s.options),
                             meanSpacing(s.callers.volume), s.options.surface);
  VORPIPE_LET(placed, s.flow->place(s.now));
  if (!placed) return refuse("volume: areas of the first cells could not be found");
  s.callers_are_old = true;
  s.last.step = s.callers.step;
  s.last.time = s.callers.time;
  s.flow->count(s.last);
  s.flow->measure(s.now, s.last);
  s.last.seconds = s.watch.seconds();
  s.judgeFrom(s.last);
  return fluid;
}

Result<bool> Fluid::step() { return state_->advance(); }

Result<void> Fluid::goOn(double until) {
  State& s = *state_;
  if (std::isnan(until)) return refuse("until: it is not a number");
  s.options.until = until;
  if (s.end == FluidEnd::areas || s.end == FluidEnd::cancelled) {
    VORPIPE_TRY(s.placeAgain());
  }
  s.end = FluidEnd::none;
  return {};
}

const FluidOptions& Fluid::options() const { return state_->options; }
const FluidState& Fluid::state() const {
  state_->update();
  return state_->callers;
}
const FluidStep& Fluid::last() const { return state_->last; }
FluidEnd Fluid::end() const { return state_->end; }
bool Fluid::hasExploded() const { return state_->has_exploded; }
const Report& Fluid::report() const {
  Report& report = state_->report;
  report = state_->flow->report();
  report.notes.insert(report.notes.end(), state_->notes.begin(), state_->notes.end());
  return report;
}

Result<void> Fluid::push(const std::vector<Point>& velocities) {
  State& s = *state_;
  if (velocities.size() != s.now.size()) {
    return refuse(fmt::format("velocities: {} for {} sites", velocities.size(), s.now.size()));
  }
  const auto wrong = std::ranges::find_if_not(velocities, [](Point v) { return isUsable(v); });
  if (wrong != velocities.end()) {
    return refuse(fmt::format("velocities: that of site {} is not finite, or beyond {:.0e}",
                              wrong - velocities.begin(), largest));
  }
  for (std::size_t k = 0; k < s.now.size(); ++k) {
    const Point more = velocities[s.now.order[k]];
    s.now.velocity[k].x += more.x;
    s.now.velocity[k].y += more.y;
  }
  s.callers_are_old = true;
  s.is_pushed = true;
  s.options.known.reset();
  return {};
}

}  // namespace vorpipe
