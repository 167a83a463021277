#include "cli/options/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/try.h"
#include "cli/options/error_line.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/sites/outline_file.h"
#include "io/sites/site_source.h"
#include "io/sites/sites_file.h"
#include "io/sites/space_source.h"
#include "view/recorder.h"

namespace vorpipe::cli {
namespace {

constexpr int most_threads = 1024;

const std::vector<std::string> weights_extensions = {".txt", ".csv", ".npy"};

std::vector<std::string> strings(const std::vector<std::string_view>& names) {
  return {names.begin(), names.end()};
}

std::string sitesDescription() {
  return fmt::format(
      "the sites: a file ({}; also with .gz after it), - for standard input, or a generator ({}:N; with "
      "--globe also {}:N). The header of "
      "CSV names x and y, or lon and lat, and perhaps weight or radius; other columns are attributes",
      anyOf(strings(sitesExtensions())), fmt::join(patternNames(), ":N, "),
      fmt::join(globePatternNames(), ":N, "));
}

/// A number of 0 or more, optionally followed by %.
Parsed<Margin> parseMargin(std::string_view text) {
  constexpr double percent = 100;
  const bool relative = text.ends_with('%');
  const auto number = parseNumber(relative ? text.substr(0, text.size() - 1) : text);
  if (!number || !(*number >= 0)) {
    return tl::unexpected(
        fmt::format("{} is neither a number of 0 or more nor one with %, as in 10%", inQuotes(text)));
  }
  return Margin{relative ? *number / percent : *number, relative};
}

/// `auto`, or a place as the center.
Parsed<ProjectChoice> parseProject(std::string_view text) {
  if (text == "auto") return ProjectChoice{};
  if (text.find(',') == std::string_view::npos) {
    return tl::unexpected(
        fmt::format("{} is neither auto nor LON,LAT, degrees of a center, as in 12.5,42", inQuotes(text)));
  }
  VORPIPE_LET(center, parsePlace(text));
  return ProjectChoice{center};
}

/// A coordinate system by a code of EPSG.
Parsed<CoordinateSystem> parseSystem(std::string_view text) {
  auto system = systemNamed(text);
  if (system) return std::move(*system);
  return tl::unexpected(fmt::format("{}, as in EPSG:25832", system.error()));
}

/// --domain, --domain-layer, --margin, --repair, --project, --crs
void addDomainOptions(Options& options, InputOptions& input, const Option& sites) {
  addParsed(options, "--domain", input.domain, "BOX, FILE or hull",
            fmt::format(
                "what is drawn and measured: the box XMIN,YMIN,XMAX,YMAX [0,0,1,1; for files the box of the "
                "sites and a --margin], a file with its outline, polygons with holes ({}), which are "
                "dissolved where "
                "they touch or overlap, or the convex hull of the sites; generators fill the box, or the "
                "square around an outline",
                anyOf(outlineExtensions())),
            parseDomain, {{"hull"}, outlineExtensions()})
      .needs(sites);
  options
      .addText("--domain-layer", input.domain_layer, "NAME",
               "layer of a GeoPackage with the outline [its only one with polygons]")
      .needs(sites);
  addParsed(
      options, "--margin", input.margin, "M or P%",
      "margin around the sites, where --domain names no box, or around their hull: in the domain's unit, or "
      "as a part of the longer side [5%; of a hull 0]",
      parseMargin)
      .needs(sites);
  options
      .addFlag("--repair", input.repair,
               "mends polygons of --domain that cross themselves, and says what it changed")
      .needs(sites);
  addParsed(
      options, "--project", input.project, "auto or LON,LAT",
      "the sites and the domain are in degrees: cells are made in an equal-area plane around their middle, "
      "or around LON,LAT; positions come back in degrees, areas in square kilometers",
      parseProject, {{"auto"}, {}})
      .needs(sites);
  addParsed(
      options, "--crs", input.crs, "EPSG:N",
      "coordinate system of sites, and of an outline, whose files name none: outputs that can name it do "
      "[that of the outline, for sites that name none]",
      parseSystem, {{"EPSG:"}, {}})
      .needs(sites);
}

/// One to three names or numbers, separated by commas.
Parsed<std::vector<std::string>> parseColumns(std::string_view text) {
  std::vector<std::string> columns;
  std::string_view rest = text;
  while (true) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    columns.emplace_back(rest.substr(0, end));
    if (columns.back().empty() || columns.size() > 4) {
      return tl::unexpected(
          fmt::format("{} is not X,Y or X,Y,W, in space X,Y,Z or X,Y,Z,W, or one column of WKT",
                      vorpipe::inQuotes(text)));
    }
    if (end == rest.size()) return columns;
    rest.remove_prefix(end + 1);
  }
}

Parsed<bool> parseMissing(std::string_view text) {
  if (text == "skip") return true;
  return tl::unexpected(fmt::format("{} is not skip", vorpipe::inQuotes(text)));
}

/// --columns, --missing, --layer, --format. Attributes are dropped unless the subcommand keeps them.
void addReadingOptions(Options& options, InputOptions& input, const Option& sites) {
  input.reading.attributes = false;
  addParsed(options, "--columns", input.reading.columns, "X,Y[,W]",
            "columns of the file's positions, in space X,Y,Z, and weights, by name, in any case, or by "
            "number from 1; one alone has "
            "points in WKT [as the header says]",
            parseColumns)
      .needs(sites);
  addParsed(options, "--missing", input.reading.skip_missing, "skip",
            "leaves out rows without a place or a weight, and counts them [they are errors]", parseMissing,
            {{"skip"}, {}})
      .needs(sites);
  options.addText("--layer", input.reading.layer, "NAME", "layer of a GeoPackage [its only one with points]")
      .needs(sites);
  addParsed(options, "--format", input.format, "KIND",
            "kind of file that comes by standard input, and goes to standard output: its extension without "
            "the dot, "
            "or two as in csv,geojson [csv]",
            parseFormat);
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

Option addFolder(Options& options, const std::string& name, std::string& target, StepsTo to,
                 const std::string& description) {
  const bool may_be_film = to == StepsTo::folder_or_film;
  Choices choices;
  if (may_be_film) choices.extensions.emplace_back(view::film_extension);
  return addParsed(
      options, name, target, may_be_film ? "FILE" : "FOLDER", description,
      [to](std::string_view text) { return parseFolder(text, to); }, std::move(choices));
}

Option addReport(Options& options, const std::string& name, std::string& target,
                 const std::string& description) {
  const auto parse = [](std::string_view text) {
    return text == "-" ? Parsed<std::string>(standard_output) : parseFile(text, "");
  };
  return addParsed(options, name, target, "FILE", description + "; - is standard output", parse,
                   {{}, {".json"}});
}

Choices sitesChoices() {
  Choices choices{{}, strings(sitesExtensions())};
  for (const std::string_view extension : extensionsOfSpace()) choices.extensions.emplace_back(extension);
  for (const auto& names : {patternNames(), globePatternNames(), spacePatternNames()}) {
    for (const std::string_view pattern : names) choices.words.push_back(fmt::format("{}:", pattern));
  }
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
            "axes along which the domain repeats itself: cells go on at the other side; z with --dim 3",
            parsePeriodic, {periodicNames(), {}})
      .needs(sites);
  return sites;
}

Option addDimension(Options& options, InputOptions& input) {
  options.group("Domain");
  addParsed(options, "--lattice", input.lattice, "A,B,C",
            "sites in space repeat by three vectors, nine numbers: there is no --domain", parseLattice);
  const auto parse = [](std::string_view text) -> Parsed<bool> {
    if (text == "2" || text == "3") return text == "3";
    return tl::unexpected(fmt::format("{} is neither 2 nor 3", vorpipe::inQuotes(text)));
  };
  return addParsed(options, "--dim", input.space, "2 or 3",
                   fmt::format("3: sites are x, y and z, and cells are polyhedra in the box "
                               "XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX of --domain [3 for six numbers there, with "
                               "--lattice, for extended .xyz and {}, "
                               "and for the generators {}:N; random, jitter and clusters take it as well]",
                               fmt::join(extensionsOfSpace(), ", "), fmt::join(spacePatternNames(), ":N, ")),
                   parse, {{"2", "3"}, {}});
}

Option addGlobe(Options& options, InputOptions& input) {
  options.group("Domain");
  return options.addFlag(
      "--globe", input.globe,
      "sites are degrees of longitude and latitude of the whole Earth, and cells are those on the "
      "sphere; areas in square kilometers on the ellipsoid, lengths in kilometers");
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
