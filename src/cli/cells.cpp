#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>

#include "cli/check_cells.h"
#include "cli/command.h"
#include "cli/input.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/stats.h"
#include "io/cells_file.h"
#include "io/error.h"
#include "io/output_file.h"

namespace vorpipe::cli {
namespace {

struct CellsFile {
  std::string path;
  CellsFormat format;
};

struct CellsCommand {
  InputOptions input;
  BackendOptions backend;
  TalkOptions talk;
  SearchOptions search;
  bool check = false;
  std::vector<CellsFile> files;
  std::string stats;
};

Parsed<CellsFile> parseCellsFile(const std::string& text) {
  auto path = parseFile(text, "");
  if (!path) return tl::unexpected(std::move(path.error()));
  const auto format = cellsFormatOf(*path);
  if (!format) return tl::unexpected(format.error().message);
  return CellsFile{std::move(*path), *format};
}

/// The output files that were asked for, in the order in which they are created.
std::vector<std::string> outputPaths(const CellsCommand& command) {
  std::vector<std::string> paths;
  for (const CellsFile& file : command.files) paths.push_back(file.path);
  if (!command.stats.empty()) paths.push_back(command.stats);
  return paths;
}

Result<void> writeFiles(const CellsCommand& command, const Input& input, const Diagram& diagram,
                        std::span<OutputFile> files, const Stopwatch& total) {
  const Stopwatch watch;
  for (std::size_t i = 0; i < command.files.size(); ++i) {
    const auto written = writeCells(files[i], input.sites, diagram, command.files[i].format);
    if (!written) return written;
    if (const auto go_on = stopIfAsked(); !go_on) return go_on;
  }
  if (!command.stats.empty()) {
    const Stats stats{"cells",         input, diagram.report, watch.milliseconds(), total.milliseconds(),
                      areaSum(diagram)};
    if (const auto written = files.back().write(statsJson(stats)); !written) return written;
  }
  if (const auto go_on = stopIfAsked(); !go_on) return go_on;
  return commitAll(files);
}

void printSummary(const CellsCommand& command, const Session& session, const Input& input,
                  const Report& report, double milliseconds) {
  fmt::print("{}: {} cells ({} empty, {} duplicate), {} on {}, {:.3f} s{}{}\n",
             fmt::join(outputPaths(command), ", "), report.ok, report.empty, report.duplicate, report.backend,
             report.device, milliseconds / 1000, command.check ? ", checked" : "",
             input.sites.weight.empty() ? "" : "; weights are not used for the cells yet");
  if (command.talk.verbose && !session.choice().empty()) fmt::print("{}\n", session.choice());
}

Result<ExitCode> cells(const CellsCommand& command) {
  const Stopwatch total;
  const std::vector<std::string> paths = outputPaths(command);
  if (paths.empty()) return inputError("-o: name what to write, as in -o cells.csv (or --stats)");
  const auto input = loadInput(command.input);
  if (!input) return tl::unexpected(input.error());
  stopOnSignals();
  auto files = createOutputs(paths);
  if (!files) return tl::unexpected(std::move(files.error()));
  auto session = Session::open(command.backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  ProgressBar bar(command.talk.quiet);
  const auto diagram = session->cells(input->sites, {input->domain, command.search, bar.callback()});
  if (!diagram) return tl::unexpected(diagram.error());
  bar.clear();
  if (const auto& messages = diagram->report.validation_messages; !messages.empty()) {
    for (const std::string& message : messages) printError("validation: " + message);
    return exit_device;
  }
  if (command.check) {
    if (const std::string broken = checkCells(*input, *diagram); !broken.empty()) {
      printError("--check: " + broken);
      return exit_different;
    }
  }
  const auto written = writeFiles(command, *input, *diagram, *files, total);
  if (!written) return tl::unexpected(written.error());
  if (!command.talk.quiet) printSummary(command, *session, *input, diagram->report, total.milliseconds());
  return exit_done;
}

void addOutputFiles(CLI::App& app, std::vector<CellsFile>& files) {
  auto* option = app.add_option_function<std::vector<std::string>>(
      "-o",
      [&files](const std::vector<std::string>& paths) {
        for (const std::string& path : paths) files.push_back(*parseCellsFile(path));
      },
      "the cells in input order; .csv, .npz, .geojson, .svg, .obj, .ply, .vtk or .wkt; repeatable");
  option->type_name("FILE")->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  option->check([](const std::string& text) {
    const auto parsed = parseCellsFile(text);
    return parsed ? std::string() : parsed.error();
  });
}

}  // namespace

Subcommand addCells(CLI::App& app) {
  auto command = std::make_shared<CellsCommand>();
  CLI::App* sub =
      app.add_subcommand("cells", "computes the cells of sites: areas, centroids, neighbors, polygons");
  addInputOptions(*sub, command->input)->required();
  addOutputFiles(*sub, command->files);
  addBackendChoice(*sub, command->backend);
  addSearchOptions(*sub, command->search);
  addRunOptions(*sub, command->backend);
  addMaskOptions(*sub, command->backend.mask);
  sub->add_flag("--check", command->check, "verifies the cells; exit code 1 if a promise is broken");
  addFile(*sub, "--stats", command->stats, "", "what was done, in JSON");
  addTalkOptions(*sub, command->talk);
  return Subcommand{sub, [command] { return cells(*command); }};
}

}  // namespace vorpipe::cli
