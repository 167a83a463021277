#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>

#include "cli/check.h"
#include "cli/command.h"
#include "cli/input.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/stats.h"
#include "io/error.h"
#include "io/npy_ids.h"
#include "io/output_file.h"
#include "io/png_file.h"

namespace vorpipe::cli {
namespace {

struct RenderCommand {
  InputOptions input;
  BackendOptions backend;
  TalkOptions talk;
  RenderOptions picture{};
  std::optional<Size> size;
  bool check = false;
  std::string png, ids, stats;
};

/// The output files that were asked for, in the order in which they are created.
std::vector<std::string> outputPaths(const RenderCommand& command) {
  std::vector<std::string> paths;
  for (const std::string& path : {command.png, command.ids, command.stats}) {
    if (!path.empty()) paths.push_back(path);
  }
  return paths;
}

/// What is drawn, once the sites are known.
Result<RenderOptions> pictureOptions(const RenderCommand& command, const Input& input, ProgressBar& bar) {
  if (command.picture.color == ColorBy::weight && input.sites.weight.empty()) {
    return inputError(
        fmt::format("--color: weight needs a column of weights, {} has none", command.input.sites));
  }
  RenderOptions options = command.picture;
  options.domain = input.domain;
  const Size size = command.size.value_or(defaultSize(input.domain));
  options.width = size.width;
  options.height = size.height;
  options.progress = bar.callback();
  const std::uint64_t pictures = command.check ? 2 : 1;
  if (const auto enough = forecastPicture(size, pictures); !enough) return tl::unexpected(enough.error());
  return options;
}

Result<void> writeFiles(const RenderCommand& command, const Input& input, const Rendering& rendering,
                        std::span<OutputFile> files, const Stopwatch& total) {
  const Stopwatch watch;
  const Image& image = rendering.image;
  std::size_t next = 0;
  if (!command.png.empty()) {
    const auto written = writePng(files[next++], image.width, image.height, image.rgba);
    if (!written) return written;
  }
  if (!command.ids.empty()) {
    const auto written = writeNpyIds(files[next++], image.width, image.height, image.ids);
    if (!written) return written;
  }
  if (!command.stats.empty()) {
    const Stats stats{"render", input, rendering.report, watch.milliseconds(), total.milliseconds()};
    if (const auto written = files[next].write(statsJson(stats)); !written) return written;
  }
  if (const auto go_on = stopIfAsked(); !go_on) return go_on;
  return commitAll(files);
}

void printSummary(const RenderCommand& command, const Session& session, const Input& input,
                  const Rendering& rendering, double milliseconds) {
  const Report& report = rendering.report;
  fmt::print("{}: {} cells ({} empty, {} duplicate), {}x{}, {} on {}, {:.3f} s{}{}\n",
             fmt::join(outputPaths(command), ", "), report.ok, report.empty, report.duplicate,
             rendering.image.width, rendering.image.height, report.backend, report.device,
             milliseconds / 1000, command.check ? ", checked" : "",
             input.sites.weight.empty() ? "" : "; weights are not used for the cells yet");
  if (command.talk.verbose && !session.choice().empty()) fmt::print("{}\n", session.choice());
}

Result<ExitCode> render(const RenderCommand& command) {
  const Stopwatch total;
  const std::vector<std::string> paths = outputPaths(command);
  if (paths.empty()) return inputError("-o: name what to write, as in -o picture.png (or --ids, --stats)");
  const auto input = loadInput(command.input);
  if (!input) return tl::unexpected(input.error());
  stopOnSignals();
  auto files = createOutputs(paths);
  if (!files) return tl::unexpected(std::move(files.error()));
  auto session = Session::open(command.backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  ProgressBar bar(command.talk.quiet);
  const auto options = pictureOptions(command, *input, bar);
  if (!options) return tl::unexpected(options.error());
  const auto rendering = session->render(input->sites, *options);
  if (!rendering) return tl::unexpected(rendering.error());
  if (const auto& messages = rendering->report.validation_messages; !messages.empty()) {
    bar.clear();
    for (const std::string& message : messages) printError("validation: " + message);
    return exit_device;
  }
  if (command.check) {
    const auto broken = checkRendering(*input, *options, *rendering, command.backend.threads);
    if (!broken) return tl::unexpected(broken.error());
    bar.clear();
    if (!broken->empty()) {
      printError("--check: " + *broken);
      return exit_different;
    }
  }
  bar.clear();
  const auto written = writeFiles(command, *input, *rendering, *files, total);
  if (!written) return tl::unexpected(written.error());
  if (!command.talk.quiet) printSummary(command, *session, *input, *rendering, total.milliseconds());
  return exit_done;
}

void addPictureOptions(CLI::App& app, RenderCommand& command) {
  addFile(app, "-o", command.png, ".png", "the picture");
  addSizeOption(app, command.size);
  addFile(app, "--ids", command.ids, ".npy",
          "the site of each pixel: uint32, row 0 at the top, 4294967295 where there is none");
  addParsed(app, "--color", command.picture.color, "BY", "site, area, neighbors or weight [site]",
            parseColor);
  addParsed(app, "--colormap", command.picture.colormap, "NAME",
            fmt::format("{} [{}]", fmt::join(colormaps(), ", "), command.picture.colormap), parseColormap);
  app.add_flag("--edges", command.picture.edges, "darkens the edges of the cells");
  app.add_flag("--show-sites", command.picture.show_sites, "a dot at each site");
}

}  // namespace

Subcommand addRender(CLI::App& app) {
  auto command = std::make_shared<RenderCommand>();
  CLI::App* sub = app.add_subcommand("render", "draws the Voronoi diagram of sites");
  addInputOptions(*sub, command->input)->required();
  addPictureOptions(*sub, *command);
  addBackendChoice(*sub, command->backend);
  addSearchOptions(*sub, command->picture.search);
  addRunOptions(*sub, command->backend);
  addMaskOptions(*sub, command->backend.mask);
  sub->add_flag("--check", command->check,
                "verifies the picture, pixel by pixel; exit code 1 if it is wrong");
  addFile(*sub, "--stats", command->stats, "", "what was done, in JSON");
  addTalkOptions(*sub, command->talk);
  return Subcommand{sub, [command] { return render(*command); }};
}

}  // namespace vorpipe::cli
