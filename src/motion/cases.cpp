#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe {
namespace {

using std::numbers::pi;

constexpr std::array<std::pair<std::string_view, FluidCase>, 5> names{{
    {"taylor-green", FluidCase::taylor_green},
    {"gresho", FluidCase::gresho},
    {"shear", FluidCase::shear},
    {"rayleigh-taylor", FluidCase::rayleigh_taylor},
    {"dam-break", FluidCase::dam_break},
}};

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

template <class Velocity>
void setVelocities(FluidState& state, const Velocity& velocity) {
  for (std::size_t i = 0; i < state.sites.size(); ++i) {
    state.velocity.push_back(velocity(Point{state.sites.x[i], state.sites.y[i]}));
  }
}

void setTaylorGreen(FluidSetup& setup, std::uint64_t parcels) {
  setup.options.domain = {0, 0, 1, 1};
  setup.options.until = 0.5;
  setup.state.sites = squaresIn(setup.options.domain, parcels);
  setVelocities(setup.state, taylorGreen);
}

void setGresho(FluidSetup& setup, std::uint64_t parcels) {
  setup.options.domain = {-0.5, -0.5, 0.5, 0.5};
  setup.options.until = 1;
  setup.state.sites = squaresIn(setup.options.domain, parcels);
  setVelocities(setup.state, gresho);
}

void setShear(FluidSetup& setup, std::uint64_t parcels) {
  setup.options.domain = {0, 0, 1, 1};
  setup.options.periodic = Periodic::xy;
  setup.options.until = 1;
  setup.state.sites = squaresIn(setup.options.domain, parcels);
  setVelocities(setup.state, shear);
}

/// A heavy fluid above a light one of a third of its density, in a box that is twice as high as wide; their
/// border is a wave of the box's width.
void setRayleighTaylor(FluidSetup& setup, std::uint64_t parcels) {
  setup.options.domain = {0, -1, 1, 1};
  setup.options.gravity = {0, -1};
  setup.options.until = 2.5;
  setup.state.sites = squaresIn(setup.options.domain, parcels);
  for (std::size_t i = 0; i < setup.state.sites.size(); ++i) {
    const double border = 0.05 * std::cos(2 * pi * setup.state.sites.x[i]);
    setup.state.density.push_back(setup.state.sites.y[i] > border ? 3 : 1);
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

}  // namespace

std::vector<std::string> fluidCaseNames() {
  std::vector<std::string> all;
  for (const auto& [name, which] : names) all.emplace_back(name);
  return all;
}

std::optional<FluidCase> fluidCaseOf(std::string_view name) {
  for (const auto& [known, which] : names) {
    if (known == name) return which;
  }
  return std::nullopt;
}

FluidSetup fluidCase(FluidCase which, std::uint64_t parcels) {
  FluidSetup setup{};
  switch (which) {
    case FluidCase::taylor_green:
      setTaylorGreen(setup, parcels);
      break;
    case FluidCase::gresho:
      setGresho(setup, parcels);
      break;
    case FluidCase::shear:
      setShear(setup, parcels);
      break;
    case FluidCase::rayleigh_taylor:
      setRayleighTaylor(setup, parcels);
      break;
    case FluidCase::dam_break:
      setDamBreak(setup, parcels);
      break;
  }
  return setup;
}

std::optional<Point> steadyVelocity(FluidCase which, Point at) {
  if (which == FluidCase::taylor_green) return taylorGreen(at);
  if (which == FluidCase::gresho) return gresho(at);
  return std::nullopt;
}

}  // namespace vorpipe
