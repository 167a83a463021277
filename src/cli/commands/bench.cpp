#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>

#include "base/try.h"
#include "bench/driver_threads.h"
#include "bench/tables.h"
#include "cli/commands/command.h"
#include "cli/forecast.h"
#include "cli/input.h"
#include "cli/options/error_line.h"
#include "cli/options/options.h"
#include "cli/progress.h"
#include "cli/run.h"
#include "io/base/error.h"
#include "io/base/quoted.h"
#include "io/cells/forecast_files.h"

namespace vorpipe::cli {
namespace {

struct NamedTable {
  std::string_view name;
  bench::Bench measure;
  bool has_curves;
};

constexpr std::array<NamedTable, 5> tables = {{{"scaling", bench::scaling, true},
                                               {"stages", bench::stages, false},
                                               {"inputs", bench::inputs, false},
                                               {"memory", bench::memory, true},
                                               {"thesis", bench::thesis, true}}};

constexpr int most_repetitions = 1000;
/// Limits for the quick selection, and for whole tables, which may end with fewer by themselves.
constexpr std::uint64_t quick_sites = 100'000, all_sites = 16'000'000;
constexpr std::uint64_t quick_side = 2000;

struct BenchCommand {
  std::vector<std::string> tables;
  std::vector<std::string> backends;
  BackendOptions backend;
  TalkOptions talk;
  std::vector<std::string> sites;
  std::uint64_t repetitions = bench::usual_repetitions;
  std::optional<std::uint64_t> max_sites;
  std::optional<std::uint64_t> max_side;
  std::optional<std::uint64_t> memory_limit;
  std::string json, markdown, plot;
};

std::vector<const NamedTable*> wantedTables(const BenchCommand& command) {
  std::vector<const NamedTable*> wanted;
  for (const NamedTable& table : tables) {
    const auto is_it = [&](const std::string& name) { return name == table.name || name == "all"; };
    if (command.tables.empty() || std::ranges::any_of(command.tables, is_it)) wanted.push_back(&table);
  }
  return wanted;
}

/// Opens all named backends, each of which must work; without names, all that can be opened.
Result<std::vector<bench::OpenedDevice>> openBackends(const BenchCommand& command,
                                                      std::vector<std::string>& unusable) {
  std::vector<bench::OpenedDevice> opened;
  const bool named_all = !command.backends.empty();
  const std::vector<std::string> every = {"vulkan-compute", "cpu", "vulkan-geometry", "opengl"};
  for (const std::string& name : named_all ? command.backends : every) {
    VORPIPE_TRY(stopIfAsked());
    BackendOptions options = command.backend;
    options.name = name;
    const auto session = Session::open(options);
    if (session) {
      if (command.talk.verbose && !session->choice().empty()) printNote(session->choice());
      opened.push_back({name, session->device()});
    } else if (named_all || session.error().code != ErrorCode::device) {
      return tl::unexpected(session.error());
    } else {
      unusable.push_back(fmt::format("{}: not measured: {}", name, session.error().message));
    }
  }
  return opened;
}

/// Returns why a job would not fit into this machine's memory, or into --memory-limit.
std::string refusal(const bench::Job& job, std::uint64_t sites, std::optional<std::uint64_t> limit) {
  Workload work;
  work.sites = sites;
  work.backend = job.backend;
  work.threads = job.threads;
  MemoryPlan plan;
  planSites(plan, "", sites, false);
  planSession(plan, work);
  if (job.side > 0) {
    RenderOptions picture{};
    picture.width = picture.height = job.side;
    planPicture(plan, work, picture);
  } else {
    planCells(plan, work, job.detail);
  }
  const auto lack = lackOfMemory(plan.peak(), limit);
  return lack ? "not tried: " + *lack : "";
}

Result<std::vector<bench::DataSet>> loadFiles(const std::vector<std::string>& paths) {
  std::vector<bench::DataSet> sets;
  for (const std::string& path : paths) {
    InputOptions options;
    options.sites = path;
    VORPIPE_VAR(input, loadInput(options));
    const std::string name = input.seed ? path : std::filesystem::path(path).filename().string();
    sets.push_back({name, std::move(input.sites), input.domain});
  }
  return sets;
}

Result<bench::Settings> settingsOf(const BenchCommand& command,
                                   const std::vector<bench::OpenedDevice>& opened) {
  bench::Settings settings;
  VORPIPE_VAR(files, loadFiles(command.sites));
  settings.files = std::move(files);
  for (const bench::OpenedDevice& backend : opened) settings.backends.push_back(backend.name);
  settings.options = command.backend;
  settings.repetitions = static_cast<int>(command.repetitions);
  const bool quick = command.tables.empty();
  settings.max_sites = command.max_sites.value_or(quick ? quick_sites : all_sites);
  settings.max_side =
      static_cast<int>(command.max_side.value_or(quick ? quick_side : bench::largest_picture));
  settings.refusal = [limit = command.memory_limit](const bench::Job& job, std::uint64_t sites) {
    return refusal(job, sites, limit);
  };
  std::error_code none;
  settings.program = std::filesystem::read_symlink("/proc/self/exe", none).string();
  return settings;
}

/// Measures table by table; passes the text of each to `say` as soon as it is ready.
Result<bench::Findings> measure(const BenchCommand& command, bench::Lab& lab,
                                const std::function<void(const std::string&)>& say) {
  bench::Findings all;
  for (const NamedTable* table : wantedTables(command)) {
    auto found = table->measure(lab);
    if (!found) return found;
    for (auto& each : found->tables) {
      say('\n' + bench::markdown(each));
      all.tables.push_back(std::move(each));
    }
    for (auto& plot : found->plots) all.plots.push_back(std::move(plot));
  }
  return all;
}

Result<ExitCode> bench(const BenchCommand& command) {
  setDriverThreads(command.backend.threads);
  const auto wanted = wantedTables(command);
  if (!command.plot.empty() && std::ranges::none_of(wanted, &NamedTable::has_curves)) {
    return inputError("--plot: the tables that were named have no curves; scaling, memory and thesis have");
  }
  std::string text, report, caption;
  bench::Findings findings;
  std::vector<std::string> paths;
  std::vector<Writer> writers;
  const auto add = [&](const std::string& path, const std::function<std::string()>& make) {
    if (path.empty()) return;
    paths.push_back(path);
    writers.emplace_back([make](ByteSink& to) { return to.write(make()); });
  };
  add(command.json, [&] { return report; });
  add(command.markdown, [&] { return text; });
  add(command.plot, [&] { return svg(findings.plots, caption); });
  VORPIPE_VAR(files, createFiles(paths));

  std::vector<std::string> unusable;
  VORPIPE_LET(opened, openBackends(command, unusable));
  VORPIPE_VAR(settings, settingsOf(command, opened));
  ProgressBar bar(command.talk.quiet);
  settings.progress = bar.callback();
  const auto say = [&](const std::string& more) {
    bar.clear();
    text += more;
    printSummary(command.talk, paths, more);
    std::fflush(stdout);
  };
  const bench::Machine machine = bench::thisMachine();
  bench::Lab lab(std::move(settings));
  const bench::Conditions conditions{machine, opened, unusable, lab.settings()};
  say(bench::markdown(conditions));
  caption = fmt::format("vorpipe {}, revision {}; {}, {} threads; {}", machine.version, machine.revision,
                        machine.cpu, machine.hardware_threads, machine.time);
  auto measured = measure(command, lab, say);
  bar.clear();
  if (!measured) return tl::unexpected(std::move(measured.error()));
  findings = std::move(*measured);
  report = bench::reportJson(conditions, findings.tables);
  VORPIPE_TRY(writeOutputs(files, writers));
  if (lab.failures().empty()) return exit_done;
  return deviceError(
      fmt::format("{} measurements failed, as {}", lab.failures().size(), lab.failures().front()));
}

/// Returns the names that TABLE accepts.
std::vector<std::string> tableNames() {
  std::vector<std::string> names;
  for (const NamedTable& table : tables) names.emplace_back(table.name);
  names.emplace_back("all");
  return names;
}

std::string wrongTable(const std::string& text) {
  const auto names = tableNames();
  const bool known = std::ranges::find(names, text) != names.end();
  return known ? "" : fmt::format("{} is not one of {}", vorpipe::inQuotes(text), fmt::join(names, ", "));
}

}  // namespace

void addBench(CommandLine& line) {
  auto command = std::make_shared<BenchCommand>();
  Options options = line.addSubcommand("bench", "measures how fast it is, and prints tables in Markdown",
                                       [command](const Invocation&) { return bench(*command); });
  options.addList("TABLE",
                  {"",
                   wrongTable,
                   [tables = &command->tables](const std::string& name) { tables->push_back(name); },
                   {tableNames(), {}}},
                  fmt::format("what is measured: {} [all, up to {} sites: some minutes]", anyOf(tableNames()),
                              quick_sites));
  options.group("Device");
  addParsed(
      options, "--backend", command->backends, "NAME[,NAME...]",
      fmt::format("what computes: one or more of {} [all that can be used]", fmt::join(backendNames(), ", ")),
      parseBackendList, {backendNames(), {}, true});
  addDeviceChoice(options, command->backend);
  options.group("Measurement");
  const auto whole = [](std::uint64_t most) {
    return [most](std::string_view text) { return parseWhole(text, 1, most); };
  };
  addParsed(
      options, "--repetitions", command->repetitions, "N",
      fmt::format("how often each is measured, after one time to warm up [{}]", bench::usual_repetitions),
      whole(most_repetitions));
  addParsed(options, "--max-sites", command->max_sites, "N", "leaves out what has more sites",
            whole(all_sites));
  addParsed(options, "--max-side", command->max_side, "N", "leaves out pictures with longer sides",
            whole(bench::largest_picture));
  options.group("Input");
  addRepeatable(
      options, "--sites", "FILE",
      "real data for the table inputs, as other subcommands take them; repeatable",
      [](std::string_view text) { return Parsed<std::string>(text); },
      [sites = &command->sites](std::string path) { sites->push_back(std::move(path)); }, sitesChoices());
  addRunOptions(options, command->backend, command->memory_limit);
  options.group("Output");
  addAnyFile(options, "--json", command->json, {".json"}, "every figure with all its samples, in JSON");
  addAnyFile(options, "--markdown", command->markdown, {".md"}, "what is printed, in a file");
  addFile(options, "--plot", command->plot, ".svg", "the curves");
  addTalkOptions(options, command->talk, command->backend.waiting);
}

}  // namespace vorpipe::cli
