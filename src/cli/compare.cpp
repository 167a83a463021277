#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "cli/command.h"
#include "cli/comparison.h"
#include "cli/input.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/run_end.h"
#include "io/png_file.h"

namespace vorpipe::cli {
namespace {

struct CompareCommand {
  std::vector<std::string> backends;
  InputOptions input;
  BackendOptions backend;
  TalkOptions talk;
  RenderOptions picture{};
  std::optional<Size> size;
  std::string report, png;
};

std::vector<std::string> outputPaths(const CompareCommand& command) {
  std::vector<std::string> paths;
  for (const std::string& path : {command.report, command.png}) {
    if (!path.empty()) paths.push_back(path);
  }
  return paths;
}

Result<RenderOptions> pictureOptions(const CompareCommand& command, const Input& input) {
  RenderOptions options = command.picture;
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  const Size size = command.size.value_or(defaultSize(input.domain));
  options.width = size.width;
  options.height = size.height;
  const std::uint64_t runs = command.backends.size(), pairs = runs * (runs - 1) / 2;
  const std::uint64_t montage = command.png.empty() ? 0 : pairs + runs;
  return forecastPicture(size, runs + pairs + montage).map([&] { return options; });
}

/// The cells of what is drawn.
CellsOptions cellsOptions(const RenderOptions& picture) {
  CellsOptions options{};
  options.domain = picture.domain;
  options.outline = picture.outline;
  options.periodic = picture.periodic;
  options.search = picture.search;
  options.detail = Detail::measures;
  options.progress = picture.progress;
  return options;
}

Result<BackendRun> runBackend(const CompareCommand& command, const std::string& name, const Input& input,
                              RenderOptions picture) {
  BackendOptions backend = command.backend;
  backend.name = name;
  auto session = Session::open(backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  ProgressBar bar(command.talk.quiet);
  picture.progress = bar.callback();
  const Stopwatch render_watch;
  auto rendering = session->render(input.sites, picture);
  if (!rendering) return asOption(std::move(rendering.error()));
  const double render_ms = render_watch.milliseconds();
  const Stopwatch cells_watch;
  auto cells = session->cells(input.sites, cellsOptions(picture));
  if (!cells) return asOption(std::move(cells.error()));
  return BackendRun{name, std::move(*rendering), std::move(*cells), render_ms, cells_watch.milliseconds()};
}

/// Runs every backend; none when the validation layers spoke, after printing what they said.
Result<std::vector<BackendRun>> runBackends(const CompareCommand& command, const Input& input,
                                            const RenderOptions& options) {
  std::vector<BackendRun> runs;
  for (const std::string& name : command.backends) {
    auto run = runBackend(command, name, input, options);
    if (!run) return tl::unexpected(std::move(run.error()));
    const bool silent =
        validationIsSilent(run->rendering.report, name) && validationIsSilent(run->cells.report, name);
    if (!silent) return std::vector<BackendRun>{};
    runs.push_back(std::move(*run));
  }
  return runs;
}

Result<void> writeFiles(const CompareCommand& command, const Comparison& comparison, const Input& input,
                        std::span<OutputFile> files) {
  std::vector<Writer> writers;
  if (!command.report.empty()) {
    writers.emplace_back([&](OutputFile& to) { return to.write(comparisonJson(comparison, input)); });
  }
  if (!command.png.empty()) {
    writers.emplace_back([&](OutputFile& to) {
      const Picture montage = comparisonMontage(comparison);
      return writePng(to, montage.width, montage.height, montage.rgba);
    });
  }
  return writeOutputs(files, writers);
}

Result<ExitCode> compare(const CompareCommand& command) {
  // Cells are kept of every run while the next is at work.
  const std::uint64_t kept = (command.backends.size() - 1) * bytes_per_kept_site;
  const auto input = loadInput(command.input, bytesPerSite(Detail::measures) + kept);
  if (!input) return tl::unexpected(input.error());
  const auto options = pictureOptions(command, *input);
  if (!options) return tl::unexpected(options.error());
  auto files = openOutputs(outputPaths(command));
  if (!files) return tl::unexpected(std::move(files.error()));
  auto runs = runBackends(command, *input, *options);
  if (!runs) return tl::unexpected(std::move(runs.error()));
  if (runs->empty()) return exit_device;
  auto pairs = comparePairs(*runs, *input);
  if (!pairs) return tl::unexpected(std::move(pairs.error()));
  const Comparison comparison{std::move(*runs), std::move(*pairs)};
  const auto written = writeFiles(command, comparison, *input, *files);
  if (!written) return tl::unexpected(written.error());
  if (!command.talk.quiet) fmt::print("{}", comparisonTable(comparison));
  const std::string differences = disagreementText(comparison);
  if (differences.empty()) return exit_done;
  printError(differences);
  return exit_different;
}

}  // namespace

Subcommand addCompare(CLI::App& app) {
  auto command = std::make_shared<CompareCommand>();
  CLI::App* sub = app.add_subcommand(
      "compare",
      "draws and computes the same cells on several backends and compares every pair, pixels and cells");
  addParsed(*sub, "--backends", command->backends, "A,B,...",
            fmt::format("two or more of {}", fmt::join(backendNames(), ", ")), parseBackends)
      ->required();
  addInputOptions(*sub, command->input)->required();
  addSizeOption(*sub, command->size);
  addSearchOptions(*sub, command->picture.search);
  addRunOptions(*sub, command->backend);
  addMaskOptions(*sub, command->backend.mask);
  addFile(*sub, "--report", command->report, "", "what was found, in JSON");
  addFile(*sub, "-o", command->png, ".png", "the pictures side by side, and below each pair's differences");
  addTalkOptions(*sub, command->talk);
  return Subcommand{sub, [command] { return compare(*command); }};
}

}  // namespace vorpipe::cli
