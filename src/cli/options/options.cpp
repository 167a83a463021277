#include "cli/options/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "cli/options/domain_options.h"
#include "cli/options/error_line.h"
#include "cli/options/reading_options.h"
#include "io/base/number.h"
#include "io/sites/site_source.h"
#include "io/sites/sites_file.h"

namespace vorpipe::cli {
namespace {

constexpr int most_threads = 1024;

const std::vector<std::string> weights_extensions = {".txt", ".csv", ".npy"};

std::vector<std::string> strings(const std::vector<std::string_view>& names) {
  return {names.begin(), names.end()};
}

std::string sitesDescription() {
  return fmt::format(
      "the sites: a file ({}; also with .gz after it), - for standard input, or a generator ({}:N). The "
      "header of "
      "CSV names x and y, or lon and lat, and perhaps weight or radius; other columns are attributes",
      anyOf(strings(sitesExtensions())), fmt::join(patternNames(), ":N, "));
}

/// --weights, --random-weights
void addWeightOptions(Options& options, InputOptions& input, const Option& sites) {
  Option file = addAnyFile(
      options, "--weights", input.weights, weights_extensions,
      fmt::format("a weight for each site, one to a line: {}. The cell of site p of weight w is where "
                  "|x - p|^2 - w is least: a power diagram (also Laguerre, radical or weighted Voronoi "
                  "diagram); a radius r is the weight r^2",
                  anyOf(weights_extensions)));
  addParsed(options, "--random-weights", input.random_weights, "LO,HI",
            "weights of generated sites, evenly distributed from LO to HI, by --seed", parseWeightRange)
      .needs(sites)
      .excludes(file);
  file.needs(sites);
}

}  // namespace

Option addFile(Options& options, const std::string& name, std::string& target, const std::string& extension,
               const std::string& description) {
  return addParsed(options, name, target, "FILE" + extension, description,
                   [extension](std::string_view text) { return parseFile(text, extension); },
                   {{}, {extension}});
}

Option addAnyFile(Options& options, const std::string& name, std::string& target,
                  std::vector<std::string> usual, const std::string& description) {
  return addParsed(options, name, target, "FILE", description,
                   [](std::string_view text) { return parseFile(text, ""); }, {{}, std::move(usual)});
}

Choices sitesChoices() {
  Choices choices{{}, strings(sitesExtensions())};
  for (const std::string_view pattern : patternNames()) choices.words.push_back(fmt::format("{}:", pattern));
  return choices;
}

Option addInputOptions(Options& options, InputOptions& input) {
  options.group("Input");
  const Option sites = options.addText("--sites", input.sites, "SPEC", sitesDescription(), sitesChoices());
  addParsed(options, "--seed", input.seed, "S", "seed of the generator [1]", [](std::string_view text) {
    return parseWhole(text, 0, UINT64_MAX);
  }).needs(sites);
  addReadingOptions(options, input, sites);
  addWeightOptions(options, input, sites);
  options.group("Domain");
  addDomainOptions(options, input, sites);
  addParsed(options, "--periodic", input.periodic, anyOf(periodicNames()),
            "axes along which the domain repeats itself: cells go on at the other side", parsePeriodic,
            {periodicNames(), {}})
      .needs(sites);
  return sites;
}

void addDeviceChoice(Options& options, BackendOptions& backend) {
  options.group("Device");
  options.addText("--device", backend.device, "DEVICE",
                  "the device: its index or a part of its name, as `vorpipe devices` lists them [the best]");
}

void addBackendChoice(Options& options, BackendOptions& backend) {
  options.group("Device");
  addParsed(options, "--backend", backend.name, "NAME",
            fmt::format("what computes: {} [{}]", anyOf(backendNames()), backend.name), parseBackend,
            {backendNames(), {}});
  addDeviceChoice(options, backend);
}

void addThreads(Options& options, int& threads) {
  options.group("Run");
  addParsed(options, "--threads", threads, "N", "CPU threads [all]", [](std::string_view text) {
    return parseWhole(text, 1, most_threads).map([](std::uint64_t n) { return static_cast<int>(n); });
  });
}

void addMaskOptions(Options& options, Mask& mask) {
  options.group("Device");
  Choices limits;
  for (const std::string& name : limitNames()) limits.words.push_back(name + "=");
  addRepeatable(
      options, "--disable", "FEATURE",
      fmt::format("pretend that devices lack a feature: {}; repeatable", fmt::join(featureNames(), ", ")),
      parseFeature, [&mask](std::string name) { mask.disabled.push_back(std::move(name)); },
      {featureNames(), {}});
  addRepeatable(
      options, "--limit", "NAME=VALUE",
      fmt::format("pretend that devices have a smaller limit: {}, as in maxTexelBufferElements=65536; "
                  "repeatable",
                  fmt::join(limitNames(), ", ")),
      parseLimit, [&mask](auto limit) { mask.limits.push_back(std::move(limit)); }, std::move(limits));
}

void addRunOptions(Options& options, BackendOptions& backend, std::optional<std::uint64_t>& memory_limit) {
  addThreads(options, backend.threads);
  addParsed(options, "--memory-limit", memory_limit, "SIZE",
            "the most memory to take, as in 8GiB or 500MB: a run that needs more is refused before it begins "
            "[what this machine, and the groups and limits that it runs in, have left]",
            parseBytes);
  addMaskOptions(options, backend.mask);
  // A word that is neither yes nor no has already ended the run.
  backend.validation = validationAskedByEnvironment().value_or(false);
  options.addFlag(
      "--validate", backend.validation,
      "turns on Vulkan's validation layers, where Vulkan computes; a message of theirs fails the run "
      "[on where VORPIPE_VALIDATION is 1, yes, true or on]");
}

void addSearchOptions(Options& options, SearchOptions& search) {
  options.group("Run");
  addParsed(options, "--search", search, fmt::format("{}[:K]", anyOf(searchNames())),
            "how neighbors are found: on a uniform grid, or among the K nearest by FLANN, K from 3 to 1024 "
            "[grid; K 30]",
            parseSearch, {searchNames(), {}});
}

void addStats(Options& options, std::string& path) {
  addAnyFile(options, "--stats", path, {".json"},
             "what was done, in JSON, with hashes of all files: `vorpipe rerun` does it again");
}

void addTalkOptions(Options& options, TalkOptions& talk) {
  options.group("Run");
  const Option quiet = options.addFlag("--quiet", talk.quiet, "prints nothing but errors");
  options.addFlag("--verbose", talk.verbose, "also says why a backend was taken").excludes(quiet);
}

void addTalkOptions(Options& options, TalkOptions& talk, Waiting& waiting) {
  addTalkOptions(options, talk);
  waiting = [&talk](std::string_view what) {
    if (!talk.quiet) printNote(what);
  };
}

Result<bool> validationAskedByEnvironment() {
  const char* value = std::getenv("VORPIPE_VALIDATION");
  const std::string word = value == nullptr ? "" : lowerCase(value);
  const auto is = [&](std::string_view other) { return word == other; };
  if (std::ranges::any_of(std::array{"1", "yes", "true", "on"}, is)) return true;
  if (std::ranges::any_of(std::array{"", "0", "no", "false", "off"}, is)) return false;
  return tl::unexpected(
      Error{ErrorCode::input, fmt::format("VORPIPE_VALIDATION: \"{}\" is neither yes nor no", value)});
}

}  // namespace vorpipe::cli
