#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/try.h"
#include "cli/cells_difference.h"
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
#include "io/base/field_text.h"
#include "io/base/read_log.h"
#include "io/pictures/npy_ids.h"
#include "io/pictures/png_file.h"

namespace vorpipe::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int largest_channel = 255;

struct DiffCommand {
  std::string a, b, png, json;
  std::uint64_t max_pixels = 0;
  std::optional<int> max_difference;
  InputOptions input;
  PictureOptions picture;
  TalkOptions talk;
};

/// The outcome of a comparison: `difference`, for standard error, is empty if the two agree.
struct DiffOutcome {
  std::string agreement, difference;
  Picture picture;
  Json found = Json::object();
};

bool namesIds(const std::string& path) { return lowerExtension(path) == ".npy"; }

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
  VORPIPE_TRY(checkMap(command.picture, input.globe));
  RenderOptions options = command.picture.render;
  options.domain = input.domain;
  options.periodic = input.periodic;
  options.globe = input.globe;
  options.width = a.width;
  options.height = a.height;
  options.fit = command.picture.fit.value_or(usualFit(input));
  if (auto checked = checkView(options); !checked) return inputError("--view: " + checked.error().message);
  auto diff = diffIds(a.ids, b.ids, input.sites, options);
  return diff ? diff : asOption(std::move(diff.error()), command.input);
}

/// Says how many differences are allowed, if any are.
std::string allowedText(const DiffCommand& command) {
  if (command.max_pixels == 0) return {};
  return fmt::format("; --max-pixels allows {}", command.max_pixels);
}

Result<DiffOutcome> compareIds(const DiffCommand& command, const Image& a, const Image& b) {
  VORPIPE_LET(diff, idDiff(command, a, b));
  DiffOutcome outcome;
  outcome.found = diffJson(diff);
  outcome.agreement = fmt::format("{} pixels equal, {} ties, {} wrong{}", diff.equal, diff.ties, diff.wrong,
                                  allowedText(command));
  if (diff.wrong > command.max_pixels || diff.ties > diff.ties_allowed) {
    outcome.difference = disagreementText(diff) + allowedText(command);
  }
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

/// Counts the pixels of two pictures, as far as the options tell them apart.
std::string countsText(const DiffCommand& command, const ImageDiff& diff) {
  std::string text = fmt::format("{} pixels equal", diff.pixels.size() - diff.close - diff.different);
  if (command.max_difference) {
    text += fmt::format(", {} within {} of 255", diff.close, *command.max_difference);
  }
  if (command.max_pixels > 0) text += fmt::format(", {} differ", diff.different);
  return text + allowedText(command);
}

DiffOutcome compareColors(const DiffCommand& command, const Image& a, const Image& b) {
  const ImageDiff diff = diffImages(a.rgba, b.rgba, a.width, a.height, command.max_difference.value_or(0));
  DiffOutcome outcome;
  outcome.found = diffJson(diff);
  outcome.agreement = countsText(command, diff);
  if (diff.different > command.max_pixels) {
    outcome.difference = fmt::format(
        "{} pixels differ, by at most {} of 255, first at row {}, column {}, all in rows {} to {} and "
        "columns {} to {}{}; to tell ties from faults, render both with --ids, as a.npy and b.npy, then "
        "vorpipe diff a.npy b.npy --sites and what else they were rendered with",
        diff.different, diff.largest, diff.first_row, diff.first_column, diff.top, diff.bottom, diff.left,
        diff.right, allowedText(command));
  }
  if (!command.png.empty()) {
    outcome.picture = grayOfColors(a.rgba, a.width, a.height);
    markDifferences(outcome.picture, diff.pixels);
  }
  return outcome;
}

/// Returns the report: what was compared, what was found, and the verdict.
Json reportOf(const DiffCommand& command, const Image& a, const Image& b, const DiffOutcome& outcome) {
  const auto file = [](const std::string& path, const Image& image) {
    return Json{{"file", path}, {"size", {image.width, image.height}}};
  };
  const bool ids = namesIds(command.a);
  Json json = {{"version", version()},
               {"command", "diff"},
               {"kind", ids ? "ids" : "pictures"},
               {"a", file(command.a, a)},
               {"b", file(command.b, b)},
               {"sites", command.input.sites.empty() ? Json(nullptr) : Json(command.input.sites)},
               {"max_pixels", command.max_pixels}};
  if (!ids) json["max_difference"] = command.max_difference.value_or(0);
  json.update(outcome.found);
  json["agree"] = outcome.difference.empty();
  json["difference"] = outcome.difference.empty() ? Json(nullptr) : Json(outcome.difference);
  return json;
}

/// Writes the files that the command names; there is no picture of two sizes.
Result<void> writeFiles(const DiffCommand& command, const Json& report, const Picture& picture) {
  std::vector<std::string> paths;
  std::vector<Writer> writers;
  if (!command.json.empty()) {
    paths.push_back(command.json);
    writers.emplace_back([&](ByteSink& to) { return to.write(jsonText(report, 2)); });
  }
  if (!command.png.empty() && !picture.rgba.empty()) {
    paths.push_back(command.png);
    writers.emplace_back(
        [&](ByteSink& to) { return writePng(to, picture.width, picture.height, picture.rgba); });
  }
  VORPIPE_VAR(files, createFiles(paths));
  return writeOutputs(files, writers);
}

/// Compares two .npz files of cells.
Result<ExitCode> diffOfCells(const DiffCommand& command) {
  if (!command.png.empty() || !command.input.sites.empty() || command.max_pixels > 0 ||
      command.max_difference) {
    return inputError(fmt::format("{}: is for pictures and ids; cells are compared by what they are",
                                  !command.png.empty()           ? "-o"
                                  : !command.input.sites.empty() ? "--sites"
                                  : command.max_pixels > 0       ? "--max-pixels"
                                                                 : "--max-difference"));
  }
  VORPIPE_LET(found, compareCellsFiles(command.a, command.b));
  Json json = {{"version", version()},
               {"command", "diff"},
               {"kind", "cells"},
               {"a", {{"file", command.a}}},
               {"b", {{"file", command.b}}}};
  json.update(found.found);
  json["agree"] = found.difference.empty();
  json["difference"] = found.difference.empty() ? Json(nullptr) : Json(found.difference);
  VORPIPE_TRY(writeFiles(command, json, {}));
  if (!found.difference.empty()) {
    printError(fmt::format("{} and {} differ: {}", command.a, command.b, found.difference));
    return exit_different;
  }
  printSummary(command.talk, std::array{command.json},
               fmt::format("{} and {}: {}\n", command.a, command.b, found.agreement));
  return exit_done;
}

/// Rejects files that cannot be compared, or not with these options.
Result<void> checkKinds(const DiffCommand& command) {
  const bool ids = namesIds(command.a);
  if (ids != namesIds(command.b)) {
    return inputError(fmt::format("{} and {}: name two .npy id arrays, two PNG pictures or two .npz of cells",
                                  command.a, command.b));
  }
  if (!ids && !command.input.sites.empty()) {
    return inputError("--sites: tells ties only in .npy id arrays, not in pictures");
  }
  if (command.input.sites.empty()) {
    VORPIPE_TRY(checkMap(command.picture, /*globe=*/false));
  }
  if (ids && command.max_difference) {
    return inputError("--max-difference: ids have no channels; a number of pixels is --max-pixels");
  }
  return {};
}

Result<DiffOutcome> compare(const DiffCommand& command, const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) {
    DiffOutcome outcome;
    outcome.difference = "the sizes differ";
    return outcome;
  }
  if (namesIds(command.a)) return compareIds(command, a, b);
  return compareColors(command, a, b);
}

/// Says on standard error how the two differ.
void printDifference(const DiffCommand& command, const Image& a, const Image& b, const DiffOutcome& outcome) {
  if (a.width == b.width && a.height == b.height) {
    printError(fmt::format("{} and {} differ: {}", command.a, command.b, outcome.difference));
  } else {
    printError(fmt::format("{} is {}x{}, {} is {}x{}: {}", command.a, a.width, a.height, command.b, b.width,
                           b.height, outcome.difference));
  }
}

Result<ExitCode> diff(const DiffCommand& command) {
  const ReadLog reads(ReadLog::Notes::names);
  if (lowerExtension(command.a) == ".npz" && lowerExtension(command.b) == ".npz") return diffOfCells(command);
  VORPIPE_TRY(checkKinds(command));
  const bool ids = namesIds(command.a);
  VORPIPE_LET(a, ids ? readNpyIds(command.a) : readPng(command.a));
  VORPIPE_LET(b, ids ? readNpyIds(command.b) : readPng(command.b));
  VORPIPE_LET(outcome, compare(command, a, b));
  VORPIPE_TRY(writeFiles(command, reportOf(command, a, b, outcome), outcome.picture));
  if (!outcome.difference.empty()) {
    printDifference(command, a, b, outcome);
    return exit_different;
  }
  printSummary(command.talk, std::array{command.png, command.json},
               fmt::format("{} and {}: {}\n", command.a, command.b, outcome.agreement));
  return exit_done;
}

}  // namespace

void addDiff(CommandLine& line) {
  auto command = std::make_shared<DiffCommand>();
  Options options = line.addSubcommand(
      "diff", "compares two id arrays (.npy), two pictures (.png) or the cells of two .npz",
      [command](const Invocation&) { return diff(*command); });
  const Choices compared{{}, {".npy", ".png", ".npz"}};
  options.addText("A", command->a, "FILE", "one id array, picture or file of cells", compared).required();
  options.addText("B", command->b, "FILE", "another of the same kind", compared).required();
  options.group("Comparison");
  addParsed(options, "--max-pixels", command->max_pixels, "N",
            "exit code 0 where at most N pixels differ: ids by more than ties, pictures by more than "
            "--max-difference [0]",
            [](std::string_view text) { return parseWhole(text, 0, UINT64_MAX); });
  addParsed(options, "--max-difference", command->max_difference, "N",
            "of pictures: pixels are equal where no channel differs by more than N of 255 [0]",
            [](std::string_view text) -> Parsed<int> {
              VORPIPE_LET(largest, parseWhole(text, 0, largest_channel));
              return static_cast<int>(largest);
            });
  options.group("Output");
  addFile(options, "-o", command->png, ".png",
          "a picture of where they differ: red is wrong, yellow a tie or within --max-difference");
  addReport(options, "--json", command->json,
            "what was compared, how many pixels differ, the first of them and the verdict, in JSON");
  const Option sites = addInputOptions(options, command->input);
  addFitOption(options, command->picture.fit).needs(sites);
  addViewOption(options, command->picture.render.view).needs(sites);
  addGlobe(options, command->input).needs(sites);
  addMapOptions(options, command->picture);
  addTalkOptions(options, command->talk);
}

}  // namespace vorpipe::cli
