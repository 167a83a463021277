/// The options that several subcommands share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "cli/parse.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Adds an option whose value `parse` turns into `target`; the command line's error is `--name: ` and
/// what parse says.
template <class Target, class Parse>
CLI::Option* addParsed(CLI::App& app, const std::string& name, Target& target, const std::string& value,
                       const std::string& description, const Parse& parse) {
  auto* option = app.add_option_function<std::string>(
      name, [&target, parse](const std::string& text) { target = *parse(text); }, description);
  option->type_name(value);
  option->check([parse](const std::string& text) {
    const auto parsed = parse(text);
    return parsed ? std::string() : parsed.error();
  });
  return option;
}

/// Adds an option that may be given any number of times, with one value each time so that it does not
/// swallow what follows; `take` gets what `parse` makes of each value.
template <class Parse, class Take>
CLI::Option* addRepeatable(CLI::App& app, const std::string& name, const std::string& value,
                           const std::string& description, const Parse& parse, const Take& take) {
  auto* option = app.add_option_function<std::vector<std::string>>(
      name,
      [parse, take](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) take(*parse(text));
      },
      description);
  option->type_name(value)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  option->check([parse](const std::string& text) {
    const auto parsed = parse(text);
    return parsed ? std::string() : parsed.error();
  });
  return option;
}

/// Adds an option that names a file to write; `extension` as for parseFile.
CLI::Option* addFile(CLI::App& app, const std::string& name, std::string& target,
                     const std::string& extension, const std::string& description);

struct InputOptions {
  std::string sites;
  std::uint64_t seed = 1;
  DomainChoice domain;
  std::string weights;  ///< a file
  std::optional<WeightRange> random_weights;
  Periodic periodic = Periodic::none;
};

struct TalkOptions {
  bool quiet = false, verbose = false;
};

/// --sites, --seed, --domain, --weights, --random-weights, --periodic
CLI::Option* addInputOptions(CLI::App& app, InputOptions& options);
/// --device
void addDeviceChoice(CLI::App& app, BackendOptions& options);
/// --backend, --device
void addBackendChoice(CLI::App& app, BackendOptions& options);
/// --threads
void addThreads(CLI::App& app, int& threads);
/// --threads, --validate
void addRunOptions(CLI::App& app, BackendOptions& options);
/// --memory-limit
void addMemoryLimit(CLI::App& app, std::optional<std::uint64_t>& bytes);
/// --disable, --limit
void addMaskOptions(CLI::App& app, Mask& mask);
/// --search
void addSearchOptions(CLI::App& app, SearchOptions& options);
/// --size
void addSizeOption(CLI::App& app, std::optional<Size>& size);
/// --quiet, --verbose
void addTalkOptions(CLI::App& app, TalkOptions& options);

}  // namespace vorpipe::cli
