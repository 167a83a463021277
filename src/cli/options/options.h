/// The options that several subcommands share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "cli/options/command_line.h"
#include "cli/options/parse.h"
#include "io/base/coordinate_system.h"
#include "io/sites/site_domain.h"
#include "io/sites/sites_file.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Returns a value that `parse` reads and `take` receives. The command line's error is `--name: ` and the
/// error of `parse`.
template <class Parse, class Take>
Value parsedValue(const std::string& name, const Parse& parse, const Take& take, Choices choices = {}) {
  const auto fault = [parse](const std::string& text) {
    const auto parsed = parse(text);
    return parsed ? std::string() : parsed.error();
  };
  return {name, fault, [parse, take](const std::string& text) { take(*parse(text)); }, std::move(choices)};
}

/// Adds an option whose value `parse` reads into `target`.
template <class Target, class Parse>
Option addParsed(Options& options, const std::string& name, Target& target, const std::string& value,
                 const std::string& description, const Parse& parse, Choices choices = {}) {
  const auto keep = [&target](auto parsed) { target = std::move(parsed); };
  return options.add(name, parsedValue(value, parse, keep, std::move(choices)), description);
}

/// Adds an option that may be given any number of times; `take` receives each parsed value.
template <class Parse, class Take>
Option addRepeatable(Options& options, const std::string& name, const std::string& value,
                     const std::string& description, const Parse& parse, const Take& take,
                     Choices choices = {}) {
  return options.addRepeatable(name, parsedValue(value, parse, take, std::move(choices)), description);
}

/// Parses a file whose extension determines its format.
template <class Target, class FormatOf>
Parsed<Target> parseNamed(std::string_view text, const FormatOf& format_of) {
  VORPIPE_VAR(path, parseFile(text, ""));
  const auto format = format_of(path);
  if (!format) return tl::unexpected(format.error().message);
  return Target{std::move(path), *format};
}

/// Adds an option that names a file; `extension` as in parseFile.
Option addFile(Options& options, const std::string& name, std::string& target, const std::string& extension,
               const std::string& description);

/// The same for a file of any name; `usual` are the usual extensions.
Option addAnyFile(Options& options, const std::string& name, std::string& target,
                  std::vector<std::string> usual, const std::string& description);

/// The same for what takes the pictures or files of steps.
Option addFolder(Options& options, const std::string& name, std::string& target, StepsTo to,
                 const std::string& description);

/// The same for a report in JSON; `-` stands for standard output.
Option addReport(Options& options, const std::string& name, std::string& target,
                 const std::string& description);

/// Returns the choices for --sites.
Choices sitesChoices();

struct InputOptions {
  std::string sites;
  std::uint64_t seed = 1;
  DomainChoice domain;
  std::string domain_layer;  ///< of the domain's file
  std::string by;            ///< attribute of its features, each of which is a domain by itself
  bool keeps_whole = false;  ///< with `by`, all of them are the domain still
  std::optional<Margin> margin;
  std::optional<ProjectChoice> project;
  std::optional<CoordinateSystem> crs;  ///< of files that name none
  bool repair = false;
  std::string weights;  ///< a file
  std::optional<WeightRange> random_weights;
  AxesChoice periodic{};
  std::optional<Lattice> lattice;
  bool globe = false;
  bool space = false;     ///< --dim 3
  ReadOptions reading{};  ///< without its format: standard input has that of `format`
  FormatChoice format{};
};

struct TalkOptions {
  bool quiet = false, verbose = false;
};

/// --sites and its reading options, --seed, those of addDomainOptions, --weights, --random-weights,
/// --periodic
Option addInputOptions(Options& options, InputOptions& input);
/// --dim, --lattice
Option addDimension(Options& options, InputOptions& input);
/// --globe
Option addGlobe(Options& options, InputOptions& input);
/// --device
void addDeviceChoice(Options& options, BackendOptions& backend);
/// --backend, --device
void addBackendChoice(Options& options, BackendOptions& backend);
/// --threads
void addThreads(Options& options, int& threads);
/// --disable, --limit
void addMaskOptions(Options& options, Mask& mask);
/// --threads, --validate, --memory-limit, --disable, --limit
void addRunOptions(Options& options, BackendOptions& backend, std::optional<std::uint64_t>& memory_limit);
/// --search
void addSearchOptions(Options& options, SearchOptions& search);
/// --stats
void addStats(Options& options, std::string& path);
/// --quiet, --verbose
void addTalkOptions(Options& options, TalkOptions& talk);
/// The same; `waiting` prints a note unless --quiet. It refers to `talk`.
void addTalkOptions(Options& options, TalkOptions& talk, Waiting& waiting);

/// Whether VORPIPE_VALIDATION turns validation layers on. Error (input): it is neither a yes nor a no.
Result<bool> validationAskedByEnvironment();

}  // namespace vorpipe::cli
