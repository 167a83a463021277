#include "cli/fluid_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "cli/drawing.h"
#include "cli/forecast.h"
#include "cli/picture.h"
#include "io/base/error.h"
#include "io/cells/forecast_files.h"

namespace vorpipe::cli {
namespace {

/// Measured bytes per cell besides the diagram: parcels, their masses and weights, the matrix of Newton's
/// steps and the levels of its solver. With projection also how areas change with velocities, and discs.
constexpr std::uint64_t of_springs = 920, of_periodic = 1300, of_projection = 1300, of_surface = 1850;
/// Bytes of the smallest run.
constexpr std::uint64_t of_any = 12'000'000;

std::uint64_t bytesOf(FluidScheme scheme, Surface surface, Periodic periodic) {
  if (surface == Surface::free) return of_surface;
  if (periodic != Periodic::none) return of_periodic;
  return scheme == FluidScheme::projection ? of_projection : of_springs;
}

std::string_view optionOf(const FluidChoices& choices) {
  if (!choices.resume.empty()) return "--resume";
  return fluidCaseOf(choices.begin) ? "--particles" : "--case";
}

std::uint64_t peakOf(const FluidPlan& asked, Workload work, std::uint64_t of_fluid,
                     const std::optional<Box>& domain) {
  work.weighted = true;
  MemoryPlan plan;
  planSession(plan, work);
  plan.take("the fluid", of_any + of_fluid * work.sites);
  plan.drop(planCells(plan, work, Detail::polygons));
  const FluidTargets& targets = asked.targets;
  if (!targets.series.empty()) plan.drop(planCells(plan, work, Detail::polygons));
  if (!targets.frames.empty()) {
    const PictureSize size = sizeOf(asked.picture, domain);
    RenderOptions render = asked.picture.render;
    render.width = size.width;
    render.height = size.height;
    planDrawingAfterSteps(plan, work, render, {.pixels = true, .cells = false});
  }
  if (!targets.cells.empty()) planCells(plan, work, Detail::everything);
  for (const CellsTarget& target : targets.cells) planCellsFile(plan, work, *target.format);
  return plan.peak();
}

Result<std::uint64_t> allowed(const FluidPlan& plan, std::uint64_t bytes) {
  const auto lack = lackOfMemory(bytes, plan.limit);
  if (lack) return inputError(fmt::format("{}: {}", optionOf(plan.choices), *lack));
  return bytes;
}

}  // namespace

Result<void> forecastCase(const FluidPlan& plan) {
  const auto which = fluidCaseOf(plan.choices.begin);
  if (!plan.choices.resume.empty() || !which) return {};
  // The options of a case do not depend on its number of parcels.
  const FluidOptions options = fluidCase(*which, 64).options;
  Workload work;
  work.sites = plan.choices.particles;
  work.periodic = options.periodic != Periodic::none;
  const auto of_fluid =
      bytesOf(plan.choices.scheme.value_or(options.scheme), options.surface, options.periodic);
  return allowed(plan, peakOf(plan, work, of_fluid, options.domain)).map([](std::uint64_t) {});
}

Result<std::uint64_t> forecastFluid(const FluidPlan& plan, const FluidSetup& setup, const DeviceInfo& device,
                                    int threads) {
  const FluidOptions& options = setup.options;
  CellsOptions cells{};
  cells.domain = options.domain;
  cells.periodic = options.periodic;
  cells.search = options.search;
  const auto work = workloadOf(setup.state.sites, cells, ImagesFor::cells, device, threads);
  if (!work) return tl::unexpected(work.error());
  return allowed(
      plan, peakOf(plan, *work, bytesOf(options.scheme, options.surface, options.periodic), options.domain));
}

}  // namespace vorpipe::cli
