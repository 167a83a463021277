#include "cli/options/options.h"

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
void addWeightOptions(Options& options, InputOptions& input, const Option& sites) {
  Option file =
      addFile(options, "--weights", input.weights, "",
              "a weight for each site, a line each: .txt, .csv or .npy. The cell of site p of weight w "
              "is where |x - p|^2 - w is least: a power diagram (also Laguerre, radical or weighted "
              "Voronoi diagram); a radius r is the weight r^2");
  addParsed(options, "--random-weights", input.random_weights, "LO,HI",
            "for generators: weights evenly distributed from LO to HI, by --seed", parseWeightRange)
      .needs(sites)
      .excludes(file);
  file.needs(sites);
}

}  // namespace

Option addFile(Options& options, const std::string& name, std::string& target, const std::string& extension,
               const std::string& description) {
  return addParsed(options, name, target, extension.empty() ? "FILE" : "FILE" + extension, description,
                   [extension](std::string_view text) { return parseFile(text, extension); });
}

Option addInputOptions(Options& options, InputOptions& input) {
  const Option sites =
      options.addText("--sites", input.sites, "SPEC",
                      "random:N, square:N, hex:N, jitter:N, clusters:N, circle:N, or a file: .csv with a "
                      "header that names x, y and optionally weight or radius, .xyz, .txt, .npy; - is "
                      "CSV on standard input");
  addParsed(options, "--seed", input.seed, "S", "seed of the generator [1]", [](std::string_view text) {
    return parseWhole(text, 0, UINT64_MAX);
  }).needs(sites);
  addParsed(
      options, "--domain", input.domain, "XMIN,YMIN,XMAX,YMAX or FILE",
      "what is drawn and measured [0,0,1,1; for files the box of the sites, grown by 5 % of its longer "
      "side]; or its outline, polygons with holes: .geojson, .json or .wkt, over the square around which "
      "generators are spread",
      parseDomain)
      .needs(sites);
  addWeightOptions(options, input, sites);
  addParsed(options, "--periodic", input.periodic, "x, y or xy",
            "axes along which the domain repeats itself: cells go on at the other side", parsePeriodic)
      .needs(sites);
  return sites;
}

void addDeviceChoice(Options& options, BackendOptions& backend) {
  options.addText("--device", backend.device, "DEVICE",
                  "index or part of the name, as `vorpipe devices` lists them [the best]");
}

void addBackendChoice(Options& options, BackendOptions& backend) {
  addParsed(options, "--backend", backend.name, "NAME",
            fmt::format("{} [{}]", fmt::join(backendNames(), ", "), backend.name), parseBackend);
  addDeviceChoice(options, backend);
}

void addThreads(Options& options, int& threads) {
  addParsed(options, "--threads", threads, "N", "CPU threads [all]", [](std::string_view text) {
    return parseWhole(text, 1, most_threads).map([](std::uint64_t n) { return static_cast<int>(n); });
  });
}

void addMaskOptions(Options& options, Mask& mask) {
  addRepeatable(
      options, "--disable", "FEATURE",
      fmt::format("pretend that devices lack a feature: {}; repeatable", fmt::join(featureNames(), ", ")),
      parseFeature, [&mask](std::string name) { mask.disabled.push_back(std::move(name)); });
  addRepeatable(options, "--limit", "NAME=VALUE",
                fmt::format("pretend that devices have a smaller limit, as in maxTexelBufferElements=65536: "
                            "{}; repeatable",
                            fmt::join(limitNames(), ", ")),
                parseLimit, [&mask](auto limit) { mask.limits.push_back(std::move(limit)); });
}

void addRunOptions(Options& options, BackendOptions& backend, std::optional<std::uint64_t>& memory_limit) {
  addThreads(options, backend.threads);
  backend.validation = validationAskedByEnvironment();
  options.addFlag("--validate", backend.validation,
                  "Vulkan validation layers; a message of theirs fails the run [VORPIPE_VALIDATION=1]");
  addParsed(options, "--memory-limit", memory_limit, "SIZE",
            "the most memory to take, as in 8GiB or 500MB: a run that needs more is refused before it begins "
            "[what this machine, and the groups and limits that it runs in, have left]",
            parseBytes);
  addMaskOptions(options, backend.mask);
}

void addSearchOptions(Options& options, SearchOptions& search) {
  addParsed(
      options, "--search", search, "grid or flann[:K]",
      "how neighbors are found: a uniform grid, or the K nearest by FLANN, K from 3 to 1024 (30) [grid]",
      parseSearch);
}

void addSizeOption(Options& options, std::optional<Size>& size) {
  addParsed(options, "--size", size, "WxH", "pixels [the longer side 1000, the domain's aspect]", parseSize);
}

void addTalkOptions(Options& options, TalkOptions& talk) {
  const Option quiet = options.addFlag("--quiet", talk.quiet, "prints nothing but errors");
  options.addFlag("--verbose", talk.verbose, "also says why a backend was taken, on a terminal")
      .excludes(quiet);
}

}  // namespace vorpipe::cli
