#include "cli/view_input.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <utility>

#include "base/option_names.h"
#include "base/try.h"
#include "cli/input.h"
#include "cli/run.h"
#include "io/base/extension.h"
#include "io/cells/fluid_state.h"
#include "io/sites/density_file.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {
namespace {

constexpr std::string_view random_start = "random:100";

/// Adds an option; a value that begins with - is joined to it by =.
void add(std::vector<std::string>& to, std::string_view option, std::string value) {
  if (value.starts_with('-')) {
    to.push_back(fmt::format("{}={}", option, value));
  } else {
    to.emplace_back(option);
    to.push_back(std::move(value));
  }
}

void addReading(std::vector<std::string>& to, const InputOptions& options) {
  if (!options.reading.columns.empty()) {
    add(to, "--columns", fmt::format("{}", fmt::join(options.reading.columns, ",")));
  }
  if (options.reading.skip_missing) add(to, "--missing", "skip");
  if (!options.reading.layer.empty()) add(to, "--layer", options.reading.layer);
}

void addWeights(std::vector<std::string>& to, const InputOptions& options) {
  if (!options.weights.empty()) add(to, "--weights", options.weights);
  if (const auto& range = options.random_weights) {
    add(to, "--random-weights", fmt::format("{},{}", range->low, range->high));
  }
}

void addDomain(std::vector<std::string>& to, const InputOptions& options) {
  const DomainChoice& domain = options.domain;
  if (domain.hull) add(to, "--domain", "hull");
  if (!domain.file.empty()) add(to, "--domain", domain.file);
  if (!options.domain_layer.empty()) add(to, "--domain-layer", options.domain_layer);
  if (const auto& box = domain.box) {
    add(to, "--domain", fmt::format("{},{},{},{}", box->xmin, box->ymin, box->xmax, box->ymax));
  }
  if (const auto& margin = options.margin) {
    // 15 digits return the number as a person may have written it.
    add(to, "--margin",
        margin->relative ? fmt::format("{:.15g}%", margin->value * 100) : fmt::format("{}", margin->value));
  }
  if (options.repair) to.emplace_back("--repair");
  if (const auto& project = options.project) {
    add(to, "--project",
        project->center ? fmt::format("{},{}", project->center->x, project->center->y) : "auto");
  }
  if (options.periodic.any()) add(to, "--periodic", options.periodic.name());
}

/// Returns command-line options equivalent to these; empty for standard input.
std::vector<std::string> argumentsOf(const InputOptions& options) {
  if (options.sites == "-") return {};
  std::vector<std::string> arguments;
  add(arguments, "--sites", options.sites);
  if (options.seed != InputOptions{}.seed) add(arguments, "--seed", std::to_string(options.seed));
  addReading(arguments, options);
  addWeights(arguments, options);
  addDomain(arguments, options);
  return arguments;
}

Result<view::Opened> opened(const InputOptions& options, const TalkOptions& talk) {
  VORPIPE_VAR(input, loadInput(options));
  VORPIPE_TRY(checkInput(options, input, cellsOptionsOf(input), /*threads=*/0));
  printNotes(talk, input);
  return view::Opened{std::move(input.sites), input.domain, std::move(input.outline), input.periodic,
                      argumentsOf(options)};
}

}  // namespace

Result<view::Opened> openForView(const InputOptions& options, const TalkOptions& talk) {
  if (!options.sites.empty()) return opened(options, talk);
  InputOptions start;
  start.sites = random_start;
  start.reading.attributes = false;
  return opened(start, talk);
}

Result<view::Loaded> loadForView(const std::string& path, const InputOptions& options) {
  view::Loaded loaded;
  if (lowerExtension(path) == ".png") {
    VORPIPE_VAR(density, readDensity(path));
    // A dropped density covers the window's domain.
    density.density.box.reset();
    loaded.density = std::make_shared<const Density>(std::move(density.density));
    return loaded;
  }
  if (lowerExtension(path) == ".npz") {
    VORPIPE_VAR(setup, readFluid(path));
    setup.options.until = FluidOptions{}.until;
    loaded.opened = view::openedFluid(view::toBegin(std::move(setup)), path);
    return loaded;
  }
  InputOptions dropped;
  dropped.sites = path;
  dropped.reading.attributes = false;
  dropped.reading.skip_missing = options.reading.skip_missing;
  VORPIPE_VAR(file, opened(dropped, {.quiet = true}));
  loaded.opened = std::move(file);
  return loaded;
}

Result<view::Opened> openFluidForView(const FluidChoices& choices, const BackendOptions& backend,
                                      const SearchOptions& search) {
  VORPIPE_VAR(setup, startOf(choices));
  setup.options.search = search;
  if (!choices.given.contains("until")) setup.options.until = FluidOptions{}.until;
  VORPIPE_VAR(session, Session::open(backend));
  const auto fluid = Fluid::begin(session, std::move(setup.state), setup.options);
  if (!fluid) return asFluidOption(fluid.error(), choices);
  auto begun = std::make_shared<view::FluidSnapshot>();
  begun->setup = {fluid->state(), setup.options};
  begun->last = fluid->last();
  begun->sites = std::make_shared<const Sites>(begun->setup.state.sites);
  begun->is_begun = true;
  return view::openedFluid(std::move(begun), choices.begin.empty() ? choices.resume : choices.begin);
}

}  // namespace vorpipe::cli
