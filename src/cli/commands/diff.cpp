#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>

#include "base/try.h"
#include "cli/commands/command.h"
#include "cli/difference.h"
#include "cli/forecast.h"
#include "cli/input.h"
#include "cli/options/error_line.h"
#include "cli/options/options.h"
#include "cli/options/picture_options.h"
#include "cli/progress.h"
#include "cli/run.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/read_log.h"
#include "io/pictures/npy_ids.h"
#include "io/pictures/png_file.h"

namespace vorpipe::cli {
namespace {

struct DiffCommand {
  std::string a, b, png;
  InputOptions input;
  std::optional<Fit> fit;
  std::optional<Box> view;
  TalkOptions talk;
};

/// The outcome of a comparison: `difference`, for standard error, is empty if the two agree.
struct DiffOutcome {
  std::string agreement, difference;
  Picture picture;
};

bool namesIds(const std::string& path) { return lowerExtension(path) == ".npy"; }

/// Rejects ids of other sites: their ties cannot be determined.
Result<void> checkIds(const std::string& path, const Image& image, const Sites& sites) {
  const auto names_none = [&](std::uint32_t id) { return id != no_site && id >= sites.size(); };
  const auto found = std::ranges::find_if(image.ids, names_none);
  if (found == image.ids.end()) return {};
  const auto pixel = found - image.ids.begin();
  return inputError(fmt::format("{}: row {}, column {}: there is no site {}: --sites has {}, from 0 on", path,
                                pixel / image.width, pixel % image.width, *found, sites.size()));
}

Result<IdDiff> idDiff(const DiffCommand& command, const Image& a, const Image& b) {
  if (command.input.sites.empty()) return diffIds(a.ids, b.ids, a.width, a.height);
  const auto planDiff = [](MemoryPlan& plan, const Workload& work) {
    plan.take("the comparison", work.sites * sizeof(double[3]));
  };
  VORPIPE_TRY(forecastGenerated(command.input, planDiff, {}));
  VORPIPE_LET(input, loadInput(command.input));
  printNotes(command.talk, input);
  VORPIPE_TRY(checkIds(command.a, a, input.sites));
  VORPIPE_TRY(checkIds(command.b, b, input.sites));
  RenderOptions options{};
  options.domain = input.domain;
  options.periodic = input.periodic;
  options.width = a.width;
  options.height = a.height;
  options.view = command.view;
  options.fit = command.fit.value_or(usualFit(input));
  if (auto checked = checkView(options); !checked) return inputError("--view: " + checked.error().message);
  auto diff = diffIds(a.ids, b.ids, input.sites, options);
  return diff ? diff : asOption(std::move(diff.error()), command.input);
}

Result<DiffOutcome> compareIds(const DiffCommand& command, const Image& a, const Image& b) {
  VORPIPE_LET(diff, idDiff(command, a, b));
  DiffOutcome outcome;
  outcome.agreement = fmt::format("{} pixels equal, {} ties, {} wrong", diff.equal, diff.ties, diff.wrong);
  if (!diff.agree()) outcome.difference = disagreementText(diff);
  if (!command.png.empty()) {
    outcome.picture = grayOfIds(a.ids, a.width, a.height);
    markDifferences(outcome.picture, diff.pixels);
  }
  if (command.talk.verbose) {
    for (const IdDifference& place : diff.first) printNote(placeText(place));
    if (diff.wrong > 0) printNote("worst: " + placeText(diff.worst));
  }
  return outcome;
}

DiffOutcome compareColors(const DiffCommand& command, const Image& a, const Image& b) {
  const ImageDiff diff = diffImages(a.rgba, b.rgba, a.width, a.height);
  DiffOutcome outcome;
  outcome.agreement = fmt::format("{} pixels equal", a.rgba.size() - diff.different);
  if (diff.different > 0) {
    outcome.difference = fmt::format(
        "{} pixels differ, by at most {} of 255, first at row {}, column {}, all in rows {} to {} and "
        "columns {} to {}; to tell ties from faults, render both with --ids, as a.npy and b.npy, then "
        "vorpipe diff a.npy b.npy --sites and what else they were rendered with",
        diff.different, diff.largest, diff.first_row, diff.first_column, diff.top, diff.bottom, diff.left,
        diff.right);
  }
  if (!command.png.empty()) {
    outcome.picture = grayOfColors(a.rgba, a.width, a.height);
    markDifferences(outcome.picture, diff.pixels);
  }
  return outcome;
}

Result<void> writePicture(const std::string& path, const Picture& picture) {
  VORPIPE_VAR(files, createFiles(std::array{path}));
  const Writer writer = [&](ByteSink& to) {
    return writePng(to, picture.width, picture.height, picture.rgba);
  };
  return writeOutputs(files, std::array{writer});
}

Result<ExitCode> diff(const DiffCommand& command) {
  const ReadLog reads(ReadLog::Notes::names);
  const bool ids = namesIds(command.a);
  if (ids != namesIds(command.b)) {
    return inputError(
        fmt::format("{} and {}: name two .npy id arrays or two PNG pictures", command.a, command.b));
  }
  if (!ids && !command.input.sites.empty()) {
    return inputError("--sites: tells ties only in .npy id arrays, not in pictures");
  }
  VORPIPE_LET(a, ids ? readNpyIds(command.a) : readPng(command.a));
  VORPIPE_LET(b, ids ? readNpyIds(command.b) : readPng(command.b));
  if (a.width != b.width || a.height != b.height) {
    printError(fmt::format("{} is {}x{}, {} is {}x{}: the sizes differ", command.a, a.width, a.height,
                           command.b, b.width, b.height));
    return exit_different;
  }
  VORPIPE_LET(outcome, ids ? compareIds(command, a, b) : compareColors(command, a, b));
  if (!command.png.empty()) {
    VORPIPE_TRY(writePicture(command.png, outcome.picture));
  }
  if (!outcome.difference.empty()) {
    printError(fmt::format("{} and {} differ: {}", command.a, command.b, outcome.difference));
    return exit_different;
  }
  printSummary(command.talk, std::array{command.png},
               fmt::format("{} and {}: {}\n", command.a, command.b, outcome.agreement));
  return exit_done;
}

}  // namespace

void addDiff(CommandLine& line) {
  auto command = std::make_shared<DiffCommand>();
  Options options = line.addSubcommand("diff", "compares two id arrays (.npy) or two pictures (.png)",
                                       [command](const Invocation&) { return diff(*command); });
  const Choices compared{{}, {".npy", ".png"}};
  options.addText("A", command->a, "FILE", "one id array or picture", compared).required();
  options.addText("B", command->b, "FILE", "another of the same kind", compared).required();
  options.group("Output");
  addFile(options, "-o", command->png, ".png", "a picture of where they differ: red is wrong, yellow a tie");
  const Option sites = addInputOptions(options, command->input);
  addFitOption(options, command->fit).needs(sites);
  addViewOption(options, command->view).needs(sites);
  addTalkOptions(options, command->talk);
}

}  // namespace vorpipe::cli
