#include "motion/flow.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>

#include "base/block_sums.h"
#include "base/try.h"
#include "motion/linear/laplacian.h"
#include "motion/linear/mass_change.h"
#include "motion/memory_order.h"
#include "motion/movable.h"
#include "motion/softness.h"
#include "motion/viscosity.h"

namespace vorpipe::moving {
namespace {

/// Area change that projected velocities may cause in a step, as a part of the area tolerance. Measured: a
/// smaller value does not improve velocities of a vortex.
constexpr double enough_projected = 0.1;

/// Tolerance of areas in the middle of a step, where they only determine the directions of projections.
constexpr double tolerance_in_the_middle = 1e-3;

/// Returns the least density of the parcels. Springs of the lightest parcels are as stiff as epsilon sets,
/// those of heavier ones softer. So the unit of mass makes no difference.
double lightest(const Parcels& parcels) {
  double least = parcels.mass[0] / parcels.volume[0];
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    least = std::min(least, parcels.mass[i] / parcels.volume[i]);
  }
  return least;
}

/// Springs pull sites to the centroids anyway.
bool isCentering(const FluidOptions& options) {
  return options.centering > 0 && options.scheme == FluidScheme::projection;
}

double square(Point a) { return a.x * a.x + a.y * a.y; }

tl::unexpected<Error> cancelled(std::string_view before) {
  return tl::unexpected(Error{ErrorCode::cancelled, "stopped before " + std::string(before)});
}

/// Adds time times acceleration.
void kick(std::vector<Point>& velocity, const std::vector<Point>& acceleration, double time, int threads) {
  forAll(velocity.size(), threads, [&](std::size_t i) {
    velocity[i].x += time * acceleration[i].x;
    velocity[i].y += time * acceleration[i].y;
  });
}

/// Removes from the velocities the part that changes areas. The result is the nearest velocity that changes
/// none, weighted by masses. `least`, `continues`, `pressure` and the returned value are as in
/// solvePressure().
std::uint64_t project(const MassChange& change, std::span<const double> mass, double least, int threads,
                      const std::function<bool()>& continues, std::vector<double>& pressure,
                      std::vector<Point>& velocity) {
  std::vector<double> changed;
  change.apply(velocity, changed);
  const auto iterations = solvePressure(change, mass, changed, least, threads, pressure, continues);
  std::vector<Point> pushed;
  change.push(pressure, mass, pushed);
  kick(velocity, pushed, -1, threads);
  return iterations;
}

}  // namespace

Parcels parcelsOf(const FluidState& state, const Box& domain) {
  Parcels parcels;
  parcels.order = state.order.empty() ? memoryOrder(state.sites, domain) : state.order;
  parcels.sites = inOrder(state.sites, parcels.order);
  parcels.velocity = inOrder(state.velocity, parcels.order);
  parcels.volume = inOrder(state.volume, parcels.order);
  parcels.pressure = inOrder(state.pressure, parcels.order);
  parcels.trend = inOrder(state.trend, parcels.order);
  parcels.carried = state.carried;
  parcels.mass = parcels.volume;
  const std::vector<double> density = inOrder(state.density, parcels.order);
  for (std::size_t i = 0; i < density.size(); ++i) parcels.mass[i] *= density[i];
  return parcels;
}

void backFrom(const Parcels& parcels, FluidState& state) {
  state.order = parcels.order;
  state.carried = parcels.carried;
  for (const auto member : {&Sites::x, &Sites::y, &Sites::weight}) {
    state.sites.*member = inCallersOrder(parcels.sites.*member, parcels.order);
  }
  state.velocity = inCallersOrder(parcels.velocity, parcels.order);
  state.pressure = inCallersOrder(parcels.pressure, parcels.order);
  state.trend = inCallersOrder(parcels.trend, parcels.order);
}

Flow::Flow(Session& session, const FluidOptions& options, const Parcels& parcels)
    : options_(options),
      threads_(session.threads()),
      spacing_(meanSpacing(parcels.volume)),
      stiffness_(options.scheme == FluidScheme::springs
                     ? lightest(parcels) / (options.epsilon * options.epsilon)
                     : 0),
      cells_(session, cellsOf(options), options.surface, parcels.volume),
      allowed_(options.domain, options.outline, options.periodic) {}

/// Moves sites back into the period, and records mass times shift along gravity.
Result<void> Flow::wrap(Parcels& parcels) const {
  if (options_.periodic == Periodic::none) return {};
  VORPIPE_VAR(inside, wrapped(parcels.sites, options_.domain, options_.periodic, threads_));
  const Box& box = options_.domain;
  const auto carried = [&](const std::vector<double>& from, const std::vector<double>& to, double side) {
    return carefulSum(parcels.size(), threads_, [&](std::size_t i) {
      const double way = to[i] - from[i];
      // A shorter way is the rounding of a site that was inside, not a period.
      return std::abs(way) > side / 2 ? parcels.mass[i] * way : 0;
    });
  };
  if (options_.gravity.x != 0) {
    parcels.carried.x += carried(parcels.sites.x, inside.x, box.xmax - box.xmin);
  }
  if (options_.gravity.y != 0) {
    parcels.carried.y += carried(parcels.sites.y, inside.y, box.ymax - box.ymin);
  }
  parcels.sites = std::move(inside);
  return {};
}

/// Finds weights with which the cells have their areas. The initial weights extrapolate the last change,
/// which saves about one diagram of three.
Result<bool> Flow::areas(Parcels& parcels, double time, double tolerance) {
  std::vector<double>& weight = parcels.sites.weight;
  const std::vector<double> before = weight;
  const bool has_weights = time > 0 && before.size() == parcels.size();
  if (has_weights && parcels.trend.size() == parcels.size()) {
    forAll(parcels.size(), threads_, [&](std::size_t i) { weight[i] += time * parcels.trend[i]; });
  }
  VORPIPE_TRY(wrap(parcels));
  VORPIPE_LET(end, cells_.solve(parcels.sites, {tolerance, options_.diagrams}));
  if (end == TransportEnd::cancelled) {
    return cancelled("each cell had its area");
  }
  diagrams_ += cells_.trace().size();
  for (const TransportStep& step : cells_.trace()) iterations_ += step.linear_iterations;
  if (has_weights) {
    parcels.trend.resize(parcels.size());
    forAll(parcels.size(), threads_,
           [&](std::size_t i) { parcels.trend[i] = (weight[i] - before[i]) / time; });
  }
  return end == TransportEnd::converged;
}

/// Springs pull sites to the centroids of their cells. Then weights are pressures up to a factor: the rate at
/// which the springs' energy grows with a cell's volume.
void Flow::accelerate(Parcels& parcels) const {
  const bool springs = options_.scheme == FluidScheme::springs;
  const CellMoments& moments = cells_.cells().moments();
  parcels.acceleration.resize(parcels.size());
  if (springs) parcels.pressure.resize(parcels.size());
  forAll(parcels.size(), threads_, [&](std::size_t i) {
    const double own = stiffness_ * parcels.volume[i] / parcels.mass[i];
    const Point centroid = moments.centroid[i];
    parcels.acceleration[i] = {own * (centroid.x - parcels.sites.x[i]) + options_.gravity.x,
                               own * (centroid.y - parcels.sites.y[i]) + options_.gravity.y};
    if (springs) parcels.pressure[i] = 0.5 * stiffness_ * parcels.sites.weight[i];
  });
  if (!isCentering(options_)) return;
  parcels.off_center.resize(parcels.size());
  forAll(parcels.size(), threads_, [&](std::size_t i) {
    const Point centroid = moments.centroid[i];
    parcels.off_center[i] = {centroid.x - parcels.sites.x[i], centroid.y - parcels.sites.y[i]};
  });
}

Result<bool> Flow::place(Parcels& parcels, double time) { return place(parcels, time, options_.tolerance); }

Result<bool> Flow::place(Parcels& parcels, double time, double tolerance) {
  auto placed = areas(parcels, time, tolerance);
  if (placed && *placed) accelerate(parcels);
  return placed;
}

void Flow::drift(Parcels& parcels, double time) const {
  forAll(parcels.size(), threads_, [&](std::size_t i) {
    parcels.sites.x[i] += time * parcels.velocity[i].x;
    parcels.sites.y[i] += time * parcels.velocity[i].y;
  });
  if (isCentering(options_)) {
    const double part = -std::expm1(-time * options_.centering);
    forAll(parcels.size(), threads_, [&](std::size_t i) {
      parcels.sites.x[i] += part * parcels.off_center[i].x;
      parcels.sites.y[i] += part * parcels.off_center[i].y;
    });
  }
  if (!options_.outline.empty()) keepInside(parcels);
}

/// Beyond a box's walls a site may still be nearest to its cell. Beyond an outline it may be in a hole, or
/// nearer to another part of the fluid. So it ends at the outline, and no longer moves toward it.
void Flow::keepInside(Parcels& parcels) const {
  forAll(parcels.size(), threads_, [&](std::size_t i) {
    const Point at{parcels.sites.x[i], parcels.sites.y[i]};
    if (allowed_.contain(at)) return;
    const Point inside = allowed_.nearestTo(at);
    const Point back{inside.x - at.x, inside.y - at.y};
    Point& v = parcels.velocity[i];
    const double toward = back.x * v.x + back.y * v.y;
    if (toward < 0) {
      v.x -= toward / square(back) * back.x;
      v.y -= toward / square(back) * back.y;
    }
    parcels.sites.x[i] = inside.x;
    parcels.sites.y[i] = inside.y;
  });
}

/// Velocity Verlet of x' = v, v' = (c - x) / epsilon^2 + g, with c the centroid of the cell (Gallouet and
/// Merigot 2018, section 5, who take symplectic Euler).
Result<bool> Flow::springs(Parcels& parcels, double length) {
  kick(parcels.velocity, parcels.acceleration, length / 2, threads_);
  drift(parcels, length);
  auto placed = place(parcels, length);
  if (!placed || !*placed) return placed;
  kick(parcels.velocity, parcels.acceleration, length / 2, threads_);
  VORPIPE_TRY(diffuse(parcels, length));
  return true;
}

/// Lets the viscosity act for a time, while parcels stay where they were placed.
Result<void> Flow::diffuse(Parcels& parcels, double time) {
  if (options_.viscosity == 0) return {};
  bool stopped = false;
  const auto continues = [&] {
    stopped = stopped || (options_.progress && !options_.progress("viscosity", 0));
    return !stopped;
  };
  const Friction friction(cells_.cells(), parcels, options_, threads_);
  iterations_ += friction.act(time, parcels.velocity, continues);
  if (stopped) return cancelled("viscosity had acted");
  return {};
}

/// Zehnder, Narain and Thomaszewski 2018, algorithm 1, for sites that carry their velocities: half a step,
/// reflection about the velocities that change no area, the other half, projection onto those velocities.
Result<bool> Flow::reflection(Parcels& parcels, double length) {
  const auto half = [&](double tolerance) {
    drift(parcels, length / 2);
    auto placed = place(parcels, length / 2, tolerance);
    if (placed && *placed) kick(parcels.velocity, parcels.acceleration, length / 2, threads_);
    return placed;
  };
  const double least = enough_projected * options_.tolerance * normOf(parcels.volume, threads_) / length;
  // Finding a pressure may take longer than all else.
  bool stopped = false;
  const auto continues = [&] {
    stopped = stopped || (options_.progress && !options_.progress("pressure", 0));
    return !stopped;
  };
  const auto projectInto = [&](std::vector<double>& pressure) {
    const MassChange change(cells_.cells(), parcels.sites, options_.domain, threads_);
    iterations_ += project(change, parcels.mass, least, threads_, continues, pressure, parcels.velocity);
  };
  auto placed = half(std::max(options_.tolerance, tolerance_in_the_middle));
  if (!placed || !*placed) return placed;
  VORPIPE_TRY(diffuse(parcels, length));
  const std::vector<Point> before = parcels.velocity;
  // Starts from the last step's pressure: area changes grow with the time since, and so does this pressure.
  const double scale = -length / 2;
  for (double& pressure : parcels.pressure) pressure *= scale;
  projectInto(parcels.pressure);
  if (stopped) return cancelled("a pressure was found");
  for (double& pressure : parcels.pressure) pressure /= scale;
  forAll(parcels.size(), threads_, [&](std::size_t i) {
    parcels.velocity[i].x += parcels.velocity[i].x - before[i].x;
    parcels.velocity[i].y += parcels.velocity[i].y - before[i].y;
  });
  placed = half(options_.tolerance);
  if (!placed || !*placed) return placed;
  std::vector<double> pressure;
  projectInto(pressure);
  if (stopped) return cancelled("a pressure was found");
  return true;
}

Result<bool> Flow::advance(Parcels& parcels, double length) {
  return options_.scheme == FluidScheme::springs ? springs(parcels, length) : reflection(parcels, length);
}

/// A site moves at most a part of the spacing, and springs oscillate in at least 8 pi steps, which preserves
/// energy to 1e-3. With projection epsilon is a time as well: a flow that slows down makes no longer steps
/// than the spacing over its usual speed.
double Flow::length(const Parcels& parcels) const {
  if (options_.step > 0) return options_.step;
  const bool free = options_.surface == Surface::free;
  const double part = (free ? 0.2 : 0.5) * spacing_;
  double fastest = 0;
  for (const Point& v : parcels.velocity) fastest = std::max(fastest, square(v));
  const double pull = std::sqrt(square(options_.gravity));
  double length = options_.epsilon / (options_.scheme == FluidScheme::springs ? 4 : 2);
  if (fastest > 0) length = std::min(length, part / std::sqrt(fastest));
  if (pull > 0) length = std::min(length, std::sqrt(part / pull) / 2);
  return length;
}

void Flow::measure(const Parcels& parcels, FluidStep& step) const {
  const CellMoments& moments = cells_.cells().moments();
  const auto sum = [&](const auto& term) { return carefulSum(parcels.size(), threads_, term); };
  const auto away = [&](std::size_t i) {
    return Point{moments.centroid[i].x - parcels.sites.x[i], moments.centroid[i].y - parcels.sites.y[i]};
  };
  step.kinetic = sum([&](std::size_t i) { return parcels.mass[i] * square(parcels.velocity[i]) / 2; });
  // Springs accelerate sites; with projection a site may leave the centroid of its cell, where the mass is.
  const bool at_sites = options_.scheme == FluidScheme::springs;
  step.potential = -sum([&](std::size_t i) {
    const Point at = at_sites ? Point{parcels.sites.x[i], parcels.sites.y[i]} : moments.centroid[i];
    return parcels.mass[i] * (options_.gravity.x * at.x + options_.gravity.y * at.y);
  });
  step.potential += options_.gravity.x * parcels.carried.x + options_.gravity.y * parcels.carried.y;
  step.spring = 0;
  if (options_.scheme == FluidScheme::springs) {
    step.spring = sum([&](std::size_t i) { return moments.spread[i] + moments.mass[i] * square(away(i)); }) *
                  stiffness_ / 2;
  }
  step.momentum.x = sum([&](std::size_t i) { return parcels.mass[i] * parcels.velocity[i].x; });
  step.momentum.y = sum([&](std::size_t i) { return parcels.mass[i] * parcels.velocity[i].y; });
  step.worst = step.farthest = step.fastest = 0;
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    step.worst = std::max(step.worst, std::abs(moments.mass[i] - parcels.volume[i]) / parcels.volume[i]);
    step.farthest = std::max(step.farthest, square(away(i)));
    step.fastest = std::max(step.fastest, square(parcels.velocity[i]));
  }
  step.fastest = std::sqrt(step.fastest);
  step.farthest = std::sqrt(step.farthest) / spacing_;
  if (!hasExactVelocity(options_)) return;
  CarefulSum error, whole;
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    const Point exact = exactVelocity(options_, {parcels.sites.x[i], parcels.sites.y[i]}, step.time);
    const Point v = parcels.velocity[i];
    error.add(parcels.volume[i] * square({v.x - exact.x, v.y - exact.y}));
    whole.add(parcels.volume[i] * square(exact));
  }
  if (whole.value() > 0) step.velocity_error = std::sqrt(error.value() / whole.value());
}

void Flow::count(FluidStep& step) {
  step.diagrams += std::exchange(diagrams_, 0);
  step.linear_iterations += std::exchange(iterations_, 0);
}

}  // namespace vorpipe::moving
