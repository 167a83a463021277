#include "cli/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>

namespace vorpipe::cli {
namespace {

constexpr int most_threads = 1024;

bool validationAskedByEnvironment() {
  const char* value = std::getenv("VORPIPE_VALIDATION");
  return value != nullptr && std::string_view(value) == "1";
}

/// --weights, --random-weights
void addWeightOptions(CLI::App& app, InputOptions& options, CLI::Option* sites) {
  auto* file =
      addFile(app, "--weights", options.weights, "",
              "a weight for each site, a line each: .txt, .csv or .npy. The cell of site p of weight w "
              "is where |x - p|^2 - w is least: a power diagram (also Laguerre, radical or weighted "
              "Voronoi diagram); a radius r is the weight r^2");
  addParsed(app, "--random-weights", options.random_weights, "LO,HI",
            "for generators: weights evenly distributed from LO to HI, by --seed", parseWeightRange)
      ->needs(sites)
      ->excludes(file);
  file->needs(sites);
}

}  // namespace

CLI::Option* addFile(CLI::App& app, const std::string& name, std::string& target,
                     const std::string& extension, const std::string& description) {
  return addParsed(app, name, target, extension.empty() ? "FILE" : "FILE" + extension, description,
                   [extension](std::string_view text) { return parseFile(text, extension); });
}

CLI::Option* addInputOptions(CLI::App& app, InputOptions& options) {
  auto* sites =
      app.add_option("--sites", options.sites,
                     "random:N, square:N, hex:N, jitter:N, clusters:N, circle:N, or a file: .csv with a "
                     "header that names x, y and optionally weight or radius, .xyz, .txt, .npy; - is "
                     "CSV on standard input");
  sites->type_name("SPEC");
  addParsed(app, "--seed", options.seed, "S", "seed of the generator [1]", [](std::string_view text) {
    return parseWhole(text, 0, UINT64_MAX);
  })->needs(sites);
  addParsed(
      app, "--domain", options.domain, "XMIN,YMIN,XMAX,YMAX or FILE",
      "what is drawn and measured [0,0,1,1; for files the box of the sites, grown by 5 % of its longer "
      "side]; or its outline, polygons with holes: .geojson, .json or .wkt, over the square around which "
      "generators are spread",
      parseDomain)
      ->needs(sites);
  addWeightOptions(app, options, sites);
  addParsed(app, "--periodic", options.periodic, "x, y or xy",
            "axes along which the domain repeats itself: cells go on at the other side", parsePeriodic)
      ->needs(sites);
  return sites;
}

void addDeviceChoice(CLI::App& app, BackendOptions& options) {
  app.add_option("--device", options.device,
                 "index or part of the name, as `vorpipe devices` lists them [the best]")
      ->type_name("DEVICE");
}

void addBackendChoice(CLI::App& app, BackendOptions& options) {
  addParsed(app, "--backend", options.name, "NAME",
            fmt::format("{} [{}]", fmt::join(backendNames(), ", "), options.name), parseBackend);
  addDeviceChoice(app, options);
}

void addThreads(CLI::App& app, int& threads) {
  addParsed(app, "--threads", threads, "N", "CPU threads [all]", [](std::string_view text) {
    return parseWhole(text, 1, most_threads).map([](std::uint64_t n) { return static_cast<int>(n); });
  });
}

void addRunOptions(CLI::App& app, BackendOptions& options) {
  addThreads(app, options.threads);
  options.validation = validationAskedByEnvironment();
  app.add_flag("--validate", options.validation,
               "Vulkan validation layers; a message of theirs fails the run [VORPIPE_VALIDATION=1]");
}

void addMemoryLimit(CLI::App& app, std::optional<std::uint64_t>& bytes) {
  addParsed(app, "--memory-limit", bytes, "SIZE",
            "the most memory to take, as in 8GiB or 500MB: a run that needs more is refused before it begins "
            "[what this machine, and the groups and limits that it runs in, have left]",
            parseBytes);
}

void addMaskOptions(CLI::App& app, Mask& mask) {
  addRepeatable(
      app, "--disable", "FEATURE",
      fmt::format("pretend that devices lack a feature: {}; repeatable", fmt::join(featureNames(), ", ")),
      parseFeature, [&mask](std::string name) { mask.disabled.push_back(std::move(name)); });
  addRepeatable(app, "--limit", "NAME=VALUE",
                fmt::format("pretend that devices have a smaller limit, as in maxTexelBufferElements=65536: "
                            "{}; repeatable",
                            fmt::join(limitNames(), ", ")),
                parseLimit, [&mask](auto limit) { mask.limits.push_back(std::move(limit)); });
}

void addSearchOptions(CLI::App& app, SearchOptions& options) {
  addParsed(
      app, "--search", options, "grid or flann[:K]",
      "how neighbors are found: a uniform grid, or the K nearest by FLANN, K from 3 to 1024 (30) [grid]",
      parseSearch);
}

void addSizeOption(CLI::App& app, std::optional<Size>& size) {
  addParsed(app, "--size", size, "WxH", "pixels [the longer side 1000, the domain's aspect]", parseSize);
}

void addTalkOptions(CLI::App& app, TalkOptions& options) {
  auto* quiet = app.add_flag("--quiet", options.quiet, "prints nothing but errors");
  app.add_flag("--verbose", options.verbose, "also says why a backend was taken, on a terminal")
      ->excludes(quiet);
}

}  // namespace vorpipe::cli
