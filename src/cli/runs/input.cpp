#include "cli/runs/input.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stopwatch.h"
#include "cli/terminal/error_line.h"
#include "cli/terminal/progress.h"
#include "io/domain/outline_file.h"
#include "io/files/error.h"
#include "io/sites/degrees.h"
#include "io/sites/site_source.h"
#include "io/sites/weights_file.h"

namespace vorpipe::cli {
namespace {

Result<void> takeWeights(const InputOptions& options, Input& input) {
  const std::string_view option = options.random_weights ? "--random-weights" : "--weights";
  if (!options.random_weights && options.weights.empty()) return {};
  if (!input.sites.weight.empty()) {
    return inputError(fmt::format("{}: {} has weights of its own", option, options.sites));
  }
  if (options.random_weights) {
    if (!input.seed) {
      return inputError(fmt::format("{}: is for generators; give {} its weights by --weights or a column",
                                    option, options.sites));
    }
    const auto [low, high] = *options.random_weights;
    input.sites.weight = randomWeights(low, high, input.sites.size(), *input.seed);
    return {};
  }
  auto weights = readWeights(options.weights, input.sites.size());
  if (!weights) return named(option, std::move(weights.error()));
  input.sites.weight = std::move(*weights);
  return {};
}

Result<void> takeOutline(const InputOptions& options, Input& input) {
  auto outline = readOutline(options.domain.file);
  if (!outline) return named("--domain", std::move(outline.error()));
  if (input.periodic != Periodic::none) {
    return inputError("--periodic: a domain with an outline does not repeat itself");
  }
  input.outline = std::move(*outline);
  input.domain = boxOf(input.outline.points);
  if (input.seed) input.sites = spreadOver(input.domain, std::move(input.sites));
  return {};
}

Result<void> takeDomain(const InputOptions& options, Input& input) {
  if (!options.domain.file.empty()) return takeOutline(options, input);
  if (options.domain.box) {
    input.domain = *options.domain.box;
  } else if (!input.seed) {
    input.domain = domainOf(input.sites);
    const Box& box = input.domain;
    if (!std::isfinite(box.xmax - box.xmin) || !std::isfinite(box.ymax - box.ymin)) {
      return inputError("--domain: the sites reach too far for a default, name what to draw");
    }
  }
  return {};
}

/// The option that gives the sites their weights.
std::string_view weightsOption(const InputOptions& options) {
  if (options.random_weights) return "--random-weights";
  return options.weights.empty() ? "--sites" : "--weights";
}

std::string_view optionOf(Subject subject, const InputOptions& options) {
  switch (subject) {
    case Subject::none:
      break;
    case Subject::sites:
      return "--sites";
    case Subject::weights:
      return weightsOption(options);
    case Subject::domain:
    case Subject::outline:
      return "--domain";
    case Subject::period:
      return "--periodic";
    case Subject::density:
      return "--density";
    case Subject::search:
      return "--search";
  }
  return {};
}

/// Says so where a plane is made of degrees. (The one place that knows whether a projection was asked for.)
void noteDegrees(const InputOptions& options, Input& input) {
  if (input.seed || !looksLikeDegrees(input.sites, input.system)) return;
  input.notes.push_back(fmt::format(
      "{}: coordinates look like degrees of longitude and latitude; cells are those of the plane of degrees; "
      "--project auto makes a local plane where areas and distances are right",
      options.sites == "-" ? "<stdin>" : options.sites));
}

}  // namespace

Result<Input> loadInput(const InputOptions& options) {
  const Stopwatch watch;
  ReadOptions reading = options.reading;
  if (options.sites == "-") reading.format = options.format.input;
  auto source = loadSites(options.sites, options.seed, reading);
  if (!source) return named("--sites", std::move(source.error()));
  Input input;
  input.sites = std::move(source->table.sites);
  input.attributes = std::move(source->table.attributes);
  input.system = std::move(source->table.system);
  input.notes = std::move(source->table.notes);
  input.seed = source->seed;
  noteDegrees(options, input);
  input.periodic = options.periodic;
  if (auto taken = takeWeights(options, input); !taken) return tl::unexpected(std::move(taken.error()));
  if (auto taken = takeDomain(options, input); !taken) return tl::unexpected(std::move(taken.error()));
  input.read_ms = watch.milliseconds();
  return input;
}

void printNotes(const TalkOptions& talk, const Input& input) {
  if (talk.quiet) return;
  for (const std::string& note : input.notes) printError(fmt::format("note: {}", note));
}

tl::unexpected<Error> named(std::string_view option, Error error) {
  if (error.code == ErrorCode::input) error.message.insert(0, fmt::format("{}: ", option));
  return tl::unexpected(std::move(error));
}

tl::unexpected<Error> asOption(Error error, const InputOptions& options) {
  if (error.subject == Subject::none) return tl::unexpected(std::move(error));
  // The option stands for the subject's name.
  const std::string name = fmt::format("{}: ", nameOf(error.subject));
  if (error.message.starts_with(name)) error.message.erase(0, name.size());
  return named(optionOf(error.subject, options), std::move(error));
}

Result<void> checkInput(const InputOptions& options, const Input& input, const CellsOptions& cells,
                        int threads) {
  auto checked = vorpipe::checkInput(input.sites, cells, threads);
  return checked ? checked : asOption(std::move(checked.error()), options);
}

}  // namespace vorpipe::cli
