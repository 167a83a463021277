/// Fluids.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/try.h"
#include "c/calls.h"
#include "c/handles.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/cells/fluid_state.h"

namespace vorpipe::c {
namespace {

/// Replaces options that are not zero in `wanted`.
Result<void> takeOptions(const vorpipe_fluid_options& wanted, FluidOptions& options) {
  const std::array schemes{options.scheme, FluidScheme::springs, FluidScheme::projection};
  VORPIPE_LET(scheme, chosen(schemes, wanted.scheme, "scheme"));
  options.scheme = scheme;
  if (wanted.step != 0) options.step = wanted.step;
  if (wanted.epsilon != 0) options.epsilon = wanted.epsilon;
  if (wanted.until != 0) options.until = wanted.until;
  if (wanted.tolerance != 0) options.tolerance = wanted.tolerance;
  if (wanted.diagrams != 0) options.diagrams = wanted.diagrams;
  if (wanted.viscosity != 0) options.viscosity = wanted.viscosity;
  if (wanted.centering != 0) options.centering = wanted.centering;
  const std::array walls{options.walls, FluidWalls::slip, FluidWalls::no_slip};
  VORPIPE_LET(at_walls, chosen(walls, wanted.walls, "walls"));
  options.walls = at_walls;
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

/// Sets up a fluid from an input and `placed`, its placed form. Errors (input): an outline, a projection or a
/// density; arrays that do not match its sites; a number that names nothing.
Result<FluidSetup> fluidSetup(const vorpipe_input& input, const PlacedInput& placed,
                              const vorpipe_fluid_options& wanted) {
  if (placed.domain.globe) return inputError("globe: a fluid has its sites in a plane");
  if (placed.domain.projection)
    return inputError("project: a fluid has its sites in a plane, not in degrees");
  if (!input.density.values.empty()) return inputError("density: a fluid has densities by site");
  const std::uint64_t count = placed.sites->size();
  if (hasArrays(wanted) && wanted.count != count) {
    return inputError(fmt::format("count: {} for {} sites", wanted.count, count));
  }
  VORPIPE_VAR(cells, movingOptions(input, placed, wanted.search, wanted.search_neighbors));
  FluidSetup setup{};
  setup.options.domain = cells.domain;
  setup.options.outline = cells.outline;
  setup.options.periodic = cells.periodic;
  setup.options.search = cells.search;
  setup.options.surface = input.surface;
  setup.state.sites = *placed.sites;
  setup.state.velocity = numbersOf<Point>(wanted.velocities, count);
  setup.state.volume = numbersOf<double>(wanted.volumes, count);
  setup.state.density = numbersOf<double>(wanted.densities, count);
  VORPIPE_TRY(takeOptions(wanted, setup.options));
  return setup;
}

/// Sets up a fluid from a case or a file, with about `parcels` cells. Errors (input): there is no such case;
/// those of readFluid; arrays, which it has itself.
Result<FluidSetup> fluidSetup(const std::string& name, std::uint64_t parcels,
                              const vorpipe_fluid_options& wanted) {
  const auto named = fluidCaseOf(name);
  if (!named && lowerExtension(name) != ".npz") {
    return inputError(
        fmt::format("name: {} is none of {}, and no .npz file", name, fmt::join(fluidCaseNames(), ", ")));
  }
  if (!named && parcels != 0) return inputError(fmt::format("parcels: {} has as many as it has", name));
  if (hasArrays(wanted)) return inputError(fmt::format("velocities: {} has arrays of its own", name));
  auto setup = named ? Result<FluidSetup>(fluidCase(*named, parcels == 0 ? usualParcels(*named) : parcels))
                     : readFluid(name);
  if (!setup) return setup;
  VORPIPE_LET(search, searchOf(wanted.search, wanted.search_neighbors));
  setup->options.search = search;
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

Result<vorpipe_fluid*> begun(vorpipe_session& session, vorpipe_input input,
                             std::shared_ptr<const PlacedInput> placed, FluidSetup setup) {
  VORPIPE_VAR(fluid, Fluid::begin(session.session, std::move(setup.state), std::move(setup.options)));
  return new vorpipe_fluid{&session, std::move(placed), std::move(input), std::move(fluid)};
}

Result<vorpipe_fluid*> begun(vorpipe_session& session, const vorpipe_input& input,
                             const vorpipe_fluid_options* given) {
  VORPIPE_LET(wanted, taken(given, "vorpipe_fluid_options"));
  VORPIPE_VAR(placed, placedInput(input));
  VORPIPE_VAR(setup, fluidSetup(input, *placed, wanted));
  return begun(session, input, std::move(placed), std::move(setup));
}

Result<vorpipe_fluid*> read(vorpipe_session& session, const std::string& name, std::uint64_t parcels,
                            const vorpipe_fluid_options* given) {
  VORPIPE_LET(wanted, taken(given, "vorpipe_fluid_options"));
  VORPIPE_VAR(setup, fluidSetup(name, parcels, wanted));
  vorpipe_input input;
  input.sites = std::make_shared<const Sites>(setup.state.sites);
  input.attributes = std::make_shared<const std::vector<Attribute>>();
  input.name = name;
  input.from = SitesFrom::generator;
  if (setup.options.outline.empty()) input.domain.box = setup.options.domain;
  input.domain.outline = setup.options.outline;
  input.periodic = setup.options.periodic;
  input.surface = setup.options.surface;
  VORPIPE_VAR(placed, placedInput(input));
  return begun(session, input, std::move(placed), std::move(setup));
}

Result<vorpipe_array> arrayOf(const vorpipe_fluid& fluid, vorpipe_fluid_field field) {
  const FluidState& state = fluid.fluid.state();
  switch (field) {
    case VORPIPE_FLUID_SITES:
      fluid.places.clear();
      for (std::size_t i = 0; i < state.sites.size(); ++i) {
        fluid.places.push_back({state.sites.x[i], state.sites.y[i]});
      }
      return array(fluid.places, VORPIPE_DOUBLE);
    case VORPIPE_FLUID_WEIGHTS:
      return array(state.sites.weight, VORPIPE_DOUBLE);
    case VORPIPE_FLUID_VELOCITIES:
      return array(state.velocity, VORPIPE_DOUBLE);
    case VORPIPE_FLUID_PRESSURES:
      return array(state.pressure, VORPIPE_DOUBLE);
    case VORPIPE_FLUID_VOLUMES:
      return array(state.volume, VORPIPE_DOUBLE);
    case VORPIPE_FLUID_DENSITIES:
      return array(state.density, VORPIPE_DOUBLE);
    default:
      return noField(field);
  }
}

/// Continues a fluid until that time.
Result<void> goOn(vorpipe_fluid& fluid, double until) {
  const SessionUse use(*fluid.session);
  VORPIPE_TRY(use.begun());
  return fluid.fluid.goOn(until);
}

Result<bool> step(vorpipe_fluid& fluid) {
  const SessionUse use(*fluid.session);
  VORPIPE_TRY(use.begun());
  return fluid.fluid.step();
}

/// Between steps, when the caller's watcher runs, the session is free.
Result<void> run(vorpipe_fluid& run, const vorpipe_fluid_run_options* given) {
  const Fluid& fluid = run.fluid;
  VORPIPE_LET(wanted, taken(given, "vorpipe_fluid_run_options"));
  constexpr double never = std::numeric_limits<double>::infinity();
  const double usual = fluid.end() == FluidEnd::time ? never : fluid.options().until;
  const double until = wanted.has_until != 0 ? wanted.until : usual;
  if (until == never && wanted.steps == 0) {
    return inputError("until: name when to end, or a number of steps");
  }
  VORPIPE_TRY(goOn(run, until));
  const auto goes_on = watcherOf(wanted.watch, wanted.watch_user, &figuresOf);
  for (std::uint64_t done = 0; wanted.steps == 0 || done < wanted.steps; ++done) {
    VORPIPE_LET(more, step(run));
    if (!more || !goes_on(fluid.last())) break;
  }
  return {};
}

vorpipe_code push(Fluid& fluid, const double* velocities, std::uint64_t count) {
  const std::size_t sites = fluid.state().sites.size();
  if (count != sites) return fail(VORPIPE_INPUT, fmt::format("count: {} for {} sites", count, sites));
  std::vector<Point> more(count);
  for (std::size_t i = 0; i < count; ++i) {
    more[i] = {velocities[2 * i], velocities[2 * i + 1]};
  }
  return codeOf(fluid.push(more));
}

MovedSites movedOf(const vorpipe_fluid& fluid) {
  return {fluid.input, *fluid.placed, fluid.fluid.state().sites};
}

vorpipe_code giveFigures(const FluidStep& step, vorpipe_fluid_figures* to) {
  return codeOf(give(figuresOf(step), to, "vorpipe_fluid_figures"));
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_fluid_begin(vorpipe_session* session, const vorpipe_input* input,
                                 const vorpipe_fluid_options* options, vorpipe_fluid** fluid) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (fluid == nullptr) return missing("fluid");
  return guardedRun(*session, [&]() -> vorpipe_code {
    const auto made = begun(*session, *input, options);
    if (!made) return fail(made.error());
    *fluid = *made;
    return VORPIPE_DONE;
  });
}

vorpipe_code vorpipe_fluid_read(vorpipe_session* session, const char* name, uint64_t parcels,
                                const vorpipe_fluid_options* options, vorpipe_fluid** fluid) {
  if (session == nullptr) return missing("session");
  if (name == nullptr) return missing("name");
  if (fluid == nullptr) return missing("fluid");
  return guardedRun(*session, [&]() -> vorpipe_code {
    const auto made = read(*session, name, parcels, options);
    if (!made) return fail(made.error());
    *fluid = *made;
    return VORPIPE_DONE;
  });
}

void vorpipe_fluid_free(vorpipe_fluid* fluid) { delete fluid; }

vorpipe_code vorpipe_fluid_step(vorpipe_fluid* fluid, vorpipe_fluid_figures* figures, int32_t* more) {
  if (fluid == nullptr) return missing("fluid");
  return guardedRun(*fluid->session, [&]() -> vorpipe_code {
    if (figures != nullptr) {
      vorpipe_fluid_figures checked{};
      checked.struct_size = figures->struct_size;
      if (auto known = give({}, &checked, "vorpipe_fluid_figures"); !known) return fail(known.error());
    }
    const auto stepped = fluid->fluid.step();
    if (!stepped) return fail(stepped.error());
    if (more != nullptr) *more = *stepped ? 1 : 0;
    return figures == nullptr ? VORPIPE_DONE : giveFigures(fluid->fluid.last(), figures);
  });
}

vorpipe_code vorpipe_fluid_run(vorpipe_fluid* fluid, const vorpipe_fluid_run_options* options) {
  if (fluid == nullptr) return missing("fluid");
  return guarded([&] { return codeOf(run(*fluid, options)); });
}

vorpipe_code vorpipe_fluid_push(vorpipe_fluid* fluid, const double* velocities, uint64_t count) {
  if (fluid == nullptr) return missing("fluid");
  if (velocities == nullptr) return missing("velocities");
  return guardedRun(*fluid->session, [&] { return push(fluid->fluid, velocities, count); });
}

vorpipe_code vorpipe_fluid_array(const vorpipe_fluid* fluid, vorpipe_fluid_field field,
                                 vorpipe_array* array) {
  if (fluid == nullptr) return missing("fluid");
  if (array == nullptr) return missing("array");
  return guarded([&] { return give(arrayOf(*fluid, field), array); });
}

vorpipe_code vorpipe_fluid_last(const vorpipe_fluid* fluid, vorpipe_fluid_figures* figures) {
  if (fluid == nullptr) return missing("fluid");
  if (figures == nullptr) return missing("figures");
  return guarded([&] { return giveFigures(fluid->fluid.last(), figures); });
}

vorpipe_fluid_end vorpipe_fluid_ended(const vorpipe_fluid* fluid) {
  return fluid == nullptr ? VORPIPE_FLUID_CANCELLED : static_cast<vorpipe_fluid_end>(fluid->fluid.end());
}

double vorpipe_fluid_velocity_error(const vorpipe_fluid* fluid) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return fluid == nullptr ? unknown : fluid->fluid.last().velocity_error.value_or(unknown);
}

vorpipe_code vorpipe_fluid_report(const vorpipe_fluid* fluid, vorpipe_report* report) {
  if (fluid == nullptr) return missing("fluid");
  if (report == nullptr) return missing("report");
  return guarded([&] { return giveReport(fluid->fluid.report(), report); });
}

const char* vorpipe_fluid_note(const vorpipe_fluid* fluid, size_t index) {
  return fluid == nullptr ? nullptr : textAt(fluid->fluid.report().notes, index);
}

vorpipe_code vorpipe_fluid_input(const vorpipe_fluid* fluid, vorpipe_input** input) {
  if (fluid == nullptr) return missing("fluid");
  if (input == nullptr) return missing("input");
  return guarded([&] { return giveMoved(movedOf(*fluid), fluid->input.surface, input); });
}

vorpipe_code vorpipe_fluid_write(const vorpipe_fluid* fluid, const char* format, vorpipe_write write,
                                 void* user) {
  if (fluid == nullptr) return missing("fluid");
  if (format == nullptr) return missing("format");
  if (write == nullptr) return missing("write");
  return guarded([&] {
    if (std::strcmp(format, "npz") != 0) return writeMoved(movedOf(*fluid), format, write, user);
    auto sink = sinkOf(format, write, user);
    return codeOf(writeFluid(sink, fluid->fluid.state(), fluid->fluid.options()));
  });
}

vorpipe_code vorpipe_fluid_save(const vorpipe_fluid* fluid, const char* path) {
  if (fluid == nullptr) return missing("fluid");
  if (path == nullptr) return missing("path");
  return guarded([&] {
    if (lowerExtension(path) != ".npz") return saveMoved(movedOf(*fluid), path);
    const Fluid& f = fluid->fluid;
    return codeOf(writeFile(path, [&](ByteSink& to) { return writeFluid(to, f.state(), f.options()); }));
  });
}
