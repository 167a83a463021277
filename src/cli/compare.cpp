#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/command.h"
#include "cli/comparison.h"
#include "cli/difference_text.h"
#include "cli/input.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "io/error.h"
#include "io/output_file.h"
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
  const Size size = command.size.value_or(defaultSize(input.domain));
  options.width = size.width;
  options.height = size.height;
  const std::uint64_t runs = command.backends.size(), pairs = runs * (runs - 1) / 2;
  const std::uint64_t montage = command.png.empty() ? 0 : pairs + runs;
  if (const auto enough = forecastPicture(size, runs + pairs + montage); !enough) {
    return tl::unexpected(enough.error());
  }
  return options;
}

Result<BackendRun> runBackend(const CompareCommand& command, const std::string& name, const Input& input,
                              RenderOptions options) {
  BackendOptions backend = command.backend;
  backend.name = name;
  auto session = Session::open(backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  ProgressBar bar(command.talk.quiet);
  options.progress = bar.callback();
  const Stopwatch watch;
  auto rendering = session->render(input.sites, options);
  if (!rendering) return tl::unexpected(std::move(rendering.error()));
  return BackendRun{name, std::move(*rendering), watch.milliseconds()};
}

/// Runs every backend; none when the validation layers spoke, after printing what they said.
Result<std::vector<BackendRun>> runBackends(const CompareCommand& command, const Input& input,
                                            const RenderOptions& options) {
  std::vector<BackendRun> runs;
  for (const std::string& name : command.backends) {
    auto run = runBackend(command, name, input, options);
    if (!run) return tl::unexpected(std::move(run.error()));
    const auto& messages = run->rendering.report.validation_messages;
    for (const std::string& message : messages) printError(fmt::format("validation: {}: {}", name, message));
    if (!messages.empty()) return std::vector<BackendRun>{};
    runs.push_back(std::move(*run));
  }
  return runs;
}

Result<void> writeFiles(const CompareCommand& command, const Comparison& comparison, const Input& input,
                        std::span<OutputFile> files) {
  std::size_t next = 0;
  if (!command.report.empty()) {
    const auto written = files[next++].write(comparisonJson(comparison, input));
    if (!written) return written;
  }
  if (!command.png.empty()) {
    const Picture montage = comparisonMontage(comparison);
    const auto written = writePng(files[next], montage.width, montage.height, montage.rgba);
    if (!written) return written;
  }
  if (const auto go_on = stopIfAsked(); !go_on) return go_on;
  return commitAll(files);
}

Result<ExitCode> compare(const CompareCommand& command) {
  const auto input = loadInput(command.input);
  if (!input) return tl::unexpected(input.error());
  const auto options = pictureOptions(command, *input);
  if (!options) return tl::unexpected(options.error());
  stopOnSignals();
  auto files = createOutputs(outputPaths(command));
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
  const auto bad =
      std::ranges::find_if(comparison.pairs, [](const PairDiff& pair) { return !pair.diff.agree(); });
  if (bad == comparison.pairs.end()) return exit_done;
  printError(fmt::format("{} and {} differ: {}", comparison.runs[bad->a].name, comparison.runs[bad->b].name,
                         disagreementText(bad->diff)));
  return exit_different;
}

}  // namespace

Subcommand addCompare(CLI::App& app) {
  auto command = std::make_shared<CompareCommand>();
  CLI::App* sub =
      app.add_subcommand("compare", "draws the same sites on several backends and compares every pair");
  addParsed(*sub, "--backends", command->backends, "A,B,...", "two or more of vulkan-geometry, opengl, cpu",
            parseBackends)
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
