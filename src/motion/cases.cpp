#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// Sets squares that fill a domain, with velocities.
template <class Velocity>
void setFlow(FluidSetup& setup, std::uint64_t parcels, const Box& domain, double until,
             const Velocity& velocity) {
  setup.options.domain = domain;
  setup.options.until = until;
  setup.state.sites = squaresIn(domain, parcels);
  for (std::size_t i = 0; i < setup.state.sites.size(); ++i) {
    setup.state.velocity.push_back(velocity(Point{setup.state.sites.x[i], setup.state.sites.y[i]}));
  }
}

void setTaylorGreen(FluidSetup& setup, std::uint64_t parcels) {
  setFlow(setup, parcels, {0, 0, 1, 1}, 0.5, taylorGreen);
}

void setGresho(FluidSetup& setup, std::uint64_t parcels) {
  setFlow(setup, parcels, {-0.5, -0.5, 0.5, 0.5}, 1, gresho);
}

void setShear(FluidSetup& setup, std::uint64_t parcels) {
  setup.options.periodic = Periodic::xy;
  setFlow(setup, parcels, {0, 0, 1, 1}, 1, shear);
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

struct Case {
  std::string_view name;
  FluidCase which;
  void (*set)(FluidSetup& setup, std::uint64_t parcels);
};

constexpr std::array<Case, 5> cases{{
    {"taylor-green", FluidCase::taylor_green, setTaylorGreen},
    {"gresho", FluidCase::gresho, setGresho},
    {"shear", FluidCase::shear, setShear},
    {"rayleigh-taylor", FluidCase::rayleigh_taylor, setRayleighTaylor},
    {"dam-break", FluidCase::dam_break, setDamBreak},
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

FluidSetup fluidCase(FluidCase which, std::uint64_t parcels) {
  FluidSetup setup{};
  const auto* const found = std::ranges::find(cases, which, &Case::which);
  if (found != cases.end()) found->set(setup, parcels);
  return setup;
}

std::optional<Point> steadyVelocity(FluidCase which, Point at) {
  if (which == FluidCase::taylor_green) return taylorGreen(at);
  if (which == FluidCase::gresho) return gresho(at);
  return std::nullopt;
}

}  // namespace vorpipe
