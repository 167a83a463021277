#include "c/fluid_options.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/try.h"
#include "c/moving_options.h"
#include "c/options.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/cells/fluid_state.h"

namespace vorpipe::c {
namespace {

constexpr std::uint64_t usual_parcels = 2048;

/// Replaces options that are not zero in `wanted`.
Result<void> takeOptions(const vorpipe_fluid_options& wanted, FluidOptions& options) {
  const std::array schemes{options.scheme, FluidScheme::springs, FluidScheme::projection};
  const auto scheme = chosen(schemes, wanted.scheme, "scheme");
  if (!scheme) return tl::unexpected(scheme.error());
  options.scheme = *scheme;
  if (wanted.step != 0) options.step = wanted.step;
  if (wanted.epsilon != 0) options.epsilon = wanted.epsilon;
  if (wanted.until != 0) options.until = wanted.until;
  if (wanted.tolerance != 0) options.tolerance = wanted.tolerance;
  if (wanted.diagrams != 0) options.diagrams = wanted.diagrams;
  if (wanted.has_gravity != 0) options.gravity = {wanted.gravity_x, wanted.gravity_y};
  options.progress = progressOf(wanted.progress, wanted.progress_user);
  return {};
}

template <class Number>
std::vector<Number> numbersOf(const double* numbers, std::uint64_t count) {
  static_assert(sizeof(Number) % sizeof(double) == 0);
  if (numbers == nullptr) return {};
  const auto* const first = reinterpret_cast<const Number*>(numbers);
  return {first, first + count};
}

bool hasArrays(const vorpipe_fluid_options& wanted) {
  return wanted.velocities != nullptr || wanted.volumes != nullptr || wanted.densities != nullptr;
}

}  // namespace

Result<FluidSetup> fluidSetup(const vorpipe_input& input, const PlacedInput& placed,
                              const vorpipe_fluid_options& wanted) {
  if (placed.domain.projection)
    return inputError("project: a fluid has its sites in a plane, not in degrees");
  if (!placed.domain.outline.empty()) return inputError("outline: a fluid fills a box");
  if (!input.density.values.empty()) return inputError("density: a fluid has densities by site");
  const std::uint64_t count = placed.sites->size();
  if (hasArrays(wanted) && wanted.count != count) {
    return inputError(fmt::format("count: {} for {} sites", wanted.count, count));
  }
  auto cells = movingOptions(input, placed, wanted.search, wanted.search_neighbors);
  if (!cells) return tl::unexpected(std::move(cells.error()));
  FluidSetup setup{};
  setup.options.domain = cells->domain;
  setup.options.periodic = cells->periodic;
  setup.options.search = cells->search;
  setup.options.surface = input.surface;
  setup.state.sites = *placed.sites;
  setup.state.velocity = numbersOf<Point>(wanted.velocities, count);
  setup.state.volume = numbersOf<double>(wanted.volumes, count);
  setup.state.density = numbersOf<double>(wanted.densities, count);
  VORPIPE_TRY(takeOptions(wanted, setup.options));
  return setup;
}

Result<FluidSetup> fluidSetup(const std::string& name, std::uint64_t parcels,
                              const vorpipe_fluid_options& wanted) {
  const auto named = fluidCaseOf(name);
  if (!named && lowerExtension(name) != ".npz") {
    return inputError(
        fmt::format("name: {} is none of {}, and no .npz file", name, fmt::join(fluidCaseNames(), ", ")));
  }
  if (!named && parcels != 0) return inputError(fmt::format("parcels: {} has as many as it has", name));
  if (hasArrays(wanted)) return inputError(fmt::format("velocities: {} has arrays of its own", name));
  auto setup =
      named ? Result<FluidSetup>(fluidCase(*named, parcels == 0 ? usual_parcels : parcels)) : readFluid(name);
  if (!setup) return setup;
  const auto search = searchOf(wanted.search, wanted.search_neighbors);
  if (!search) return tl::unexpected(search.error());
  setup->options.search = *search;
  VORPIPE_TRY(takeOptions(wanted, setup->options));
  return setup;
}

vorpipe_fluid_figures figuresOf(const FluidStep& step) {
  vorpipe_fluid_figures figures{};
  figures.halvings = static_cast<std::uint32_t>(step.halvings);
  figures.step = step.step;
  figures.time = step.time;
  figures.length = step.length;
  figures.kinetic = step.kinetic;
  figures.potential = step.potential;
  figures.spring = step.spring;
  figures.energy = step.energy();
  figures.momentum_x = step.momentum.x;
  figures.momentum_y = step.momentum.y;
  figures.worst = step.worst;
  figures.farthest = step.farthest;
  figures.diagrams = step.diagrams;
  figures.linear_iterations = step.linear_iterations;
  figures.seconds = step.seconds;
  return figures;
}

}  // namespace vorpipe::c
