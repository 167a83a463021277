#include "cli/input.h"

#include <fmt/core.h>

#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"
#include "cli/progress.h"
#include "io/base/coordinate_system.h"
#include "io/base/error.h"
#include "io/base/quoted.h"
#include "io/sites/density_place.h"
#include "io/sites/outline_file.h"
#include "io/sites/site_source.h"
#include "io/sites/space_source.h"
#include "io/sites/weights_file.h"

namespace vorpipe::cli {
namespace {

/// Returns the option that sets the weights.
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
      return options.lattice ? "--lattice" : "--domain";
    case Subject::period:
      return "--periodic";
    case Subject::density:
      return "--density";
    case Subject::search:
      return "--search";
    case Subject::masses:
      return "--masses";
  }
  return {};
}

/// Takes the features that --by names as parts of the outline.
Result<void> takeParts(const InputOptions& options, const OutlineFile& file, DomainSettings& settings,
                       Input& input) {
  if (options.by.empty()) return {};
  auto found = outlinesBy(file, options.by);
  if (!found) {
    found.error().message.insert(0, fmt::format("{}: ", options.domain.file));
    return named("--by", std::move(found.error()));
  }
  for (std::size_t k = 0; k < found->outlines.size(); ++k) {
    const auto name = found->names.at(k);
    settings.parts.push_back({name ? inQuotes(*name) : "without a name", std::move(found->outlines[k])});
  }
  if (found->empty > 0) {
    input.notes.push_back(fmt::format("--by: {} of the features in {} {} no polygon, and {} left out",
                                      found->empty, options.domain.file, found->empty == 1 ? "has" : "have",
                                      found->empty == 1 ? "is" : "are"));
  }
  if (found->same > 0) {
    input.notes.push_back(
        fmt::format("--by: {} of the features in {} have the {} of one before them, and are "
                    "one with it",
                    found->same, options.domain.file, inQuotes(found->names.name())));
  }
  input.part_names = std::move(found->names);
  return {};
}

/// Finds the domain by --domain, --margin, --repair and --project.
Result<void> takeDomain(const InputOptions& options, Input& input, bool of_corners = false) {
  if (!options.domain_layer.empty() && options.domain.file.empty())
    return inputError("--domain-layer: is for a GeoPackage that --domain names");
  if (!options.by.empty() && options.domain.file.empty())
    return inputError("--by: is for features of a file that --domain names");
  if (options.periodic.z) {
    return inputError("--periodic: z is an axis of space, where there are `cells` alone; name --dim 3");
  }
  if (options.domain.space) {
    return inputError("--domain: six numbers are a box in space, where there are `cells` alone");
  }
  DomainSettings settings{.outline_name = options.domain.file,
                          .box = options.domain.box,
                          .hull = options.domain.hull,
                          .margin = options.margin,
                          .repair = options.repair,
                          .project = options.project,
                          .crs = options.crs,
                          .keeps_whole = options.keeps_whole,
                          .of_corners = of_corners,
                          .globe = options.globe};
  if (!options.domain.file.empty()) {
    const auto attributes = options.by.empty() ? FeatureAttributes::dropped : FeatureAttributes::kept;
    auto read = readOutline(options.domain.file, options.domain_layer, attributes);
    if (!read) return named("--domain", std::move(read.error()));
    VORPIPE_TRY(takeParts(options, *read, settings, input));
    settings.outline = std::move(read->outline);
    settings.outline_system = std::move(read->system);
  }
  return findDomain(settings, input, domainWords(options));
}

}  // namespace

Result<void> takeWeights(const InputOptions& options, std::size_t sites, Input& input) {
  std::vector<double>& weights = input.sites.weight;
  const std::string_view option = options.random_weights ? "--random-weights" : "--weights";
  if (!options.random_weights && options.weights.empty()) return {};
  if (!weights.empty()) {
    return inputError(fmt::format("{}: {} has weights of its own", option, options.sites));
  }
  if (options.random_weights) {
    if (!input.seed) {
      return inputError(fmt::format("{}: is for generators; give {} its weights by --weights or a column",
                                    option, options.sites));
    }
    const auto [low, high] = *options.random_weights;
    weights = randomWeights(low, high, sites, *input.seed);
    return {};
  }
  auto read = readWeights(options.weights, sites);
  if (!read) return named(option, std::move(read.error()));
  weights = std::move(*read);
  return {};
}

Result<Input> loadInput(const InputOptions& options) {
  const Stopwatch watch;
  if (isOfSpace(options.sites)) {
    return inputError(
        fmt::format("--sites: {} has sites in space, where there are `cells` alone", options.sites));
  }
  ReadOptions reading = options.reading;
  if (options.sites == "-") reading.format = options.format.input;
  auto source = loadSites(options.sites, options.seed, reading,
                          options.globe ? std::optional<Box>() : options.domain.box);
  if (!source) return named("--sites", std::move(source.error()));
  if (isOfGlobe(options.sites) && !options.globe) {
    return inputError(fmt::format("--sites: {} is of the whole Earth, and takes --globe", options.sites));
  }
  Input input;
  input.sites = std::move(source->table.sites);
  input.attributes = std::move(source->table.attributes);
  input.system = std::move(source->table.system);
  input.notes = std::move(source->table.notes);
  if (source->generator) input.seed = source->generator->seed;
  input.from = source->generator ? SitesFrom::generator : SitesFrom::file;
  input.periodic = options.periodic.plane;
  VORPIPE_TRY(takeWeights(options, input.sites.size(), input));
  VORPIPE_TRY(takeDomain(options, input));
  input.read_ms = watch.milliseconds();
  return input;
}

Result<Input> inputAround(const InputOptions& options, Sites corners) {
  Input input;
  input.sites = std::move(corners);
  input.from = SitesFrom::file;
  if (auto beside = readSystemBeside(options.sites, input.system); !beside) {
    return named("--sites", std::move(beside.error()));
  }
  VORPIPE_TRY(takeDomain(options, input, /*of_corners=*/true));
  return input;
}

CellsOptions cellsOptionsOf(const Input& input, const SearchOptions& search) {
  CellsOptions cells{};
  cells.domain = input.domain;
  cells.outline = input.outline;
  cells.periodic = input.periodic;
  cells.globe = input.globe;
  cells.search = search;
  return cells;
}

DomainWords domainWords(const InputOptions& options) {
  return {options.sites == "-" ? "<stdin>" : options.sites,
          "--domain",
          "--domain XMIN,YMIN,XMAX,YMAX",
          "--margin",
          "--repair",
          "--project",
          "--project auto",
          "--project LON,LAT",
          "--globe",
          "--periodic",
          "--density",
          "--density-box",
          "--crs"};
}

Result<DensityFile> densityOf(const DensityOptions& options) {
  if (options.empty()) return {};
  // A given box is in the unit of the domain, whatever files accompany the density.
  auto read = readDensity(options.file, options.box);
  if (!read) return named("--density", std::move(read.error()));
  return read;
}

Result<void> placeUnder(const DensityFile& density, const DensityOptions& from, const InputOptions& options,
                        Input& input) {
  return placeDensity(density, from.file, input, domainWords(options));
}

tl::unexpected<Error> named(std::string_view option, Error error) {
  if (error.code == ErrorCode::input) error.message.insert(0, fmt::format("{}: ", option));
  return tl::unexpected(std::move(error));
}

tl::unexpected<Error> asOption(Error error, const InputOptions& options) {
  if (error.subject == Subject::none) return tl::unexpected(std::move(error));
  // The option replaces the subject's name.
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
