#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/refusal.h"
#include "base/try.h"
#include "domain/rings.h"
#include "motion/movable.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe {
namespace {

using std::numbers::pi;

/// Returns the centers of about `count` squares that fill a box, row by row.
Sites squaresIn(const Box& box, std::uint64_t count) {
  const double width = box.xmax - box.xmin, height = box.ymax - box.ymin;
  const double wanted = std::sqrt(static_cast<double>(count) * width / height);
  const auto columns = static_cast<std::uint64_t>(std::max(2.0, std::round(wanted)));
  const auto rows = std::max<std::uint64_t>(2, count / columns);
  Sites sites;
  for (std::uint64_t row = 0; row < rows; ++row) {
    for (std::uint64_t column = 0; column < columns; ++column) {
      const double x = (static_cast<double>(column) + 0.5) / static_cast<double>(columns);
      const double y = (static_cast<double>(row) + 0.5) / static_cast<double>(rows);
      sites.x.push_back(box.xmin + x * width);
      sites.y.push_back(box.ymin + y * height);
    }
  }
  return sites;
}

Point taylorGreen(Point p) {
  return {std::sin(pi * p.x) * std::cos(pi * p.y), -std::cos(pi * p.x) * std::sin(pi * p.y)};
}

/// Gresho and Chan 1990: the speed rises to 1 at the radius 0.2, and falls to 0 at 0.4.
Point gresho(Point p) {
  const double radius = std::sqrt(p.x * p.x + p.y * p.y);
  if (radius == 0 || radius >= 0.4) return {0, 0};
  const double speed = radius < 0.2 ? 5 * radius : 2 - 5 * radius;
  return {-speed * p.y / radius, speed * p.x / radius};
}

/// Bell, Colella and Glaz 1989, section 4, with layers that are 1/30 thick.
Point shear(Point p) {
  const double layer = p.y <= 0.5 ? p.y - 0.25 : 0.75 - p.y;
  return {std::tanh(30 * layer), 0.05 * std::sin(2 * pi * p.x)};
}

Point shearWave(Point p) { return {std::sin(2 * pi * p.y), 0}; }

/// Poiseuille's flow between walls at y = 0 and 1, from rest under a unit acceleration: the steady parabola
/// less a series whose terms decay.
Point channel(Point p, double viscosity, double time) {
  double speed = p.y * (1 - p.y) / 2;
  // Terms fall as 1 / n^3.
  for (int n = 1; n < 400; n += 2) {
    const double wave = n * pi;
    const double decay = std::exp(-viscosity * wave * wave * time);
    speed -= 4 / (wave * wave * wave) * decay * std::sin(wave * p.y);
  }
  return {speed / viscosity, 0};
}

/// Sets squares that fill a domain, with velocities.
template <class Velocity>
void setFlow(FluidSetup& setup, std::uint64_t parcels, const Box& domain, double until,
             const Velocity& velocity, FluidCase known) {
  setup.options.known = known;
  setup.options.domain = domain;
  setup.options.until = until;
  setup.state.sites = squaresIn(domain, parcels);
  for (std::size_t i = 0; i < setup.state.sites.size(); ++i) {
    setup.state.velocity.push_back(velocity(Point{setup.state.sites.x[i], setup.state.sites.y[i]}));
  }
}

void setTaylorGreen(FluidSetup& setup, std::uint64_t parcels) {
  setFlow(setup, parcels, {0, 0, 1, 1}, 0.5, taylorGreen, FluidCase::taylor_green);
}

void setGresho(FluidSetup& setup, std::uint64_t parcels) {
  setFlow(setup, parcels, {-0.5, -0.5, 0.5, 0.5}, 1, gresho, FluidCase::gresho);
}

void setShear(FluidSetup& setup, std::uint64_t parcels) {
  setup.options.periodic = Periodic::xy;
  setFlow(setup, parcels, {0, 0, 1, 1}, 1, shear, FluidCase::shear);
}

void setShearWave(FluidSetup& setup, std::uint64_t parcels) {
  setup.options.periodic = Periodic::xy;
  setFlow(setup, parcels, {0, 0, 1, 1}, 1, shearWave, FluidCase::shear_wave);
}

void setChannel(FluidSetup& setup, std::uint64_t parcels) {
  setup.options.periodic = Periodic::x;
  setup.options.gravity = {1, 0};
  setup.options.viscosity = 0.1;
  setup.options.walls = FluidWalls::no_slip;
  const auto at_rest = [](Point) { return Point{0, 0}; };
  setFlow(setup, parcels, {0, 0, 1, 1}, 1, at_rest, FluidCase::channel);
}

/// A heavy fluid above a light one of half its density, in a box that is twice as high as wide. Their border
/// is a wave of the box's width. The lattice is moved as the wave would move it as long as it is low, which
/// changes no areas, so that the border has no steps where smaller waves would begin. Viscosity damps the
/// waves of single cells, which would grow fastest. Without centering the rim of the mushroom does not roll
/// up: sites leave their cells by several spacings, and velocities that change no areas are then few.
void setRayleighTaylor(FluidSetup& setup, std::uint64_t parcels) {
  setup.options.domain = {0, 0, 1, 2};
  setup.options.gravity = {0, -1};
  setup.options.viscosity = 0.001;
  setup.options.centering = 2;
  setup.options.until = 3.5;
  setup.options.known = FluidCase::rayleigh_taylor;
  setup.state.sites = squaresIn(setup.options.domain, parcels);
  Sites& sites = setup.state.sites;
  constexpr double wave = 2 * pi, height = 0.05, border = 1.25;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double above = sites.y[i] - border, phase = wave * sites.x[i];
    const double moved = height * std::exp(-wave * std::abs(above));
    setup.state.density.push_back(above > 0 ? 2 : 1);
    sites.x[i] += std::copysign(moved, above) * std::sin(phase);
    sites.y[i] += moved * std::cos(phase);
  }
}

/// The box and the column of Koshizuka and Oka 1996, section IV, with the width of the column as 1 meter.
void setDamBreak(FluidSetup& setup, std::uint64_t parcels) {
  const Box column{0, 0, 1, 2};
  setup.options.domain = {0, 0, 4, 3};
  setup.options.surface = Surface::free;
  setup.options.gravity = {0, -9.81};
  setup.options.until = 0.68;
  setup.state.sites = squaresIn(column, parcels);
  setup.state.volume.assign(setup.state.sites.size(), 2.0 / static_cast<double>(setup.state.sites.size()));
}

struct Case {
  std::string_view name;
  FluidCase which;
  void (*set)(FluidSetup& setup, std::uint64_t parcels);
  std::uint64_t usual_parcels = 2048;
};

constexpr std::array<Case, 7> cases{{
    {"taylor-green", FluidCase::taylor_green, setTaylorGreen},
    {"gresho", FluidCase::gresho, setGresho},
    {"shear", FluidCase::shear, setShear},
    {"rayleigh-taylor", FluidCase::rayleigh_taylor, setRayleighTaylor, 8192},
    {"dam-break", FluidCase::dam_break, setDamBreak},
    {"shear-wave", FluidCase::shear_wave, setShearWave},
    {"channel", FluidCase::channel, setChannel},
}};

}  // namespace

std::vector<std::string> fluidCaseNames() {
  std::vector<std::string> names;
  for (const Case& each : cases) names.emplace_back(each.name);
  return names;
}

std::optional<FluidCase> fluidCaseOf(std::string_view name) {
  const auto* const found = std::ranges::find(cases, name, &Case::name);
  return found == cases.end() ? std::nullopt : std::optional(found->which);
}

std::uint64_t usualParcels(FluidCase which) {
  return std::ranges::find(cases, which, &Case::which)->usual_parcels;
}

FluidSetup fluidCase(FluidCase which, std::uint64_t parcels) {
  FluidSetup setup{};
  const auto* const found = std::ranges::find(cases, which, &Case::which);
  if (found != cases.end()) found->set(setup, parcels);
  return setup;
}

Result<FluidSetup> fluidCase(FluidCase which, std::uint64_t parcels, Outline outline) {
  // The options of a case do not depend on its number of parcels.
  FluidSetup setup = fluidCase(which, 64);
  const auto refuse = [](std::string message) {
    return tl::unexpected(refusalOf(Subject::outline, std::move(message)));
  };
  const FluidOptions& options = setup.options;
  if (options.periodic != Periodic::none)
    return refuse("this case repeats itself, in a box of its own; an outline is for cases within walls");
  if (options.surface == Surface::free)
    return refuse("this case has a free surface, in a box of its own; an outline is for cases that fill it");
  VORPIPE_LET(rings, core::ringsOf(outline, 0));
  const Box &whole = options.domain, box = boxOf(outline.points);
  if (box.xmin < whole.xmin || box.ymin < whole.ymin || box.xmax > whole.xmax || box.ymax > whole.ymax) {
    return refuse(fmt::format("it reaches beyond the domain of the case, {},{},{},{}", whole.xmin, whole.ymin,
                              whole.xmax, whole.ymax));
  }
  const double part = core::areaInside(rings, box) / ((whole.xmax - whole.xmin) * (whole.ymax - whole.ymin));
  setup = fluidCase(which, static_cast<std::uint64_t>(static_cast<double>(parcels) / part));
  const moving::AllowedPlaces inside(box, outline, Periodic::none);
  FluidState& state = setup.state;
  FluidState kept;
  for (std::size_t i = 0; i < state.sites.size(); ++i) {
    if (!inside.contain({state.sites.x[i], state.sites.y[i]})) continue;
    kept.sites.x.push_back(state.sites.x[i]);
    kept.sites.y.push_back(state.sites.y[i]);
    if (!state.velocity.empty()) kept.velocity.push_back(state.velocity[i]);
    if (!state.density.empty()) kept.density.push_back(state.density[i]);
  }
  if (kept.sites.size() == 0) return refuse("no site of the case lies in it; more of them may");
  setup.state = std::move(kept);
  setup.options.domain = box;
  setup.options.outline = std::move(outline);
  return setup;
}

bool hasExactVelocity(const FluidOptions& options) {
  const bool is_still = options.gravity.x == 0 && options.gravity.y == 0;
  const bool slides = options.viscosity == 0 || options.walls == FluidWalls::slip;
  // A case may be begun in a domain of the caller's.
  if (!options.known || !options.outline.empty()) return false;
  switch (*options.known) {
    case FluidCase::taylor_green:
      return slides;
    case FluidCase::gresho:
      return options.viscosity == 0;
    case FluidCase::shear_wave:
      return is_still;
    case FluidCase::channel:
      return options.viscosity > 0 && options.walls == FluidWalls::no_slip && options.gravity == Point{1, 0};
    default:
      return false;
  }
}

Point exactVelocity(const FluidOptions& options, Point at, double time) {
  const auto decayed = [&](Point v, double squared_wave) {
    const double left = std::exp(-options.viscosity * squared_wave * time);
    return Point{left * v.x, left * v.y};
  };
  switch (options.known.value()) {
    case FluidCase::gresho:
      return gresho(at);
    case FluidCase::shear_wave:
      return decayed(shearWave(at), 4 * pi * pi);
    case FluidCase::channel:
      return channel(at, options.viscosity, time);
    default:
      return decayed(taylorGreen(at), 2 * pi * pi);
  }
}

}  // namespace vorpipe
