#include "cli/fluid_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "base/try.h"
#include "base/words.h"
#include "cli/drawing.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/output_file.h"
#include "io/base/quoted.h"
#include "io/cells/fluid_state.h"
#include "view/flowing.h"
#include "view/recorder.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::cli {
namespace {

namespace fs = std::filesystem;

/// Returns the canonical path of a folder, even if it does not exist.
fs::path placeOf(const std::string& folder) {
  std::error_code none;
  // The appended file name makes a trailing slash irrelevant.
  return fs::weakly_canonical(fs::path(folder) / "file", none).parent_path();
}

constexpr std::string_view list_of_series = "series.pvd";

/// Returns the names in a folder, except leftovers of killed runs; none if there is no folder.
Result<std::vector<std::string>> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code code;
  if (!fs::exists(folder, code)) return names;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    std::string name = entry->path().filename().string();
    if (!isLeftOver(name)) names.push_back(std::move(name));
  }
  if (code) return inputError(fmt::format("{}: {}", folder, code.message()));
  std::ranges::sort(names);
  return names;
}

/// Returns the number between `begin` and `end` in a name, if it has at least `digits` digits.
std::optional<std::uint64_t> numberIn(std::string_view name, std::string_view begin, std::string_view end,
                                      std::size_t digits) {
  if (!name.starts_with(begin) || !name.ends_with(end)) return std::nullopt;
  if (name.size() < begin.size() + digits + end.size()) return std::nullopt;
  return wholeNumber<std::uint64_t>(name.substr(begin.size(), name.size() - begin.size() - end.size()));
}

std::optional<std::uint64_t> stepIn(std::string_view name) { return numberIn(name, "step-", ".vtp", 6); }

tl::unexpected<Error> strange(const std::string& folder, const std::string& name, std::string_view what) {
  return inputError(fmt::format("{}: holds {}, which is none of {}", folder, vorpipe::inQuotes(name), what));
}

/// Returns a name such as "step-000010.vtp".
std::string seriesFileOf(std::uint64_t step) { return fmt::format("step-{:06}.vtp", step); }

/// Opens the folder of a new series, creating it if needed. Errors (input): it cannot be made, or is not
/// empty.
Result<void> createSeries(const std::string& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return inputError(fmt::format("{}: {}", folder, code.message()));
  VORPIPE_LET(names, namesIn(folder));
  if (names.empty()) return {};
  return inputError(folder + ": the folder holds something; a series wants an empty one");
}

/// Returns the steps of a series up to the checkpoint's step; none if the folder is empty. Files of later
/// steps were written after the checkpoint, and will be overwritten. Errors (input): the folder holds
/// something else, or a series without this step.
Result<std::vector<SeriesStep>> continueSeries(const std::string& folder, const FluidState& from) {
  VORPIPE_LET(names, namesIn(folder));
  if (names.empty()) return createSeries(folder).map([] { return std::vector<SeriesStep>(); });
  for (const std::string& name : names) {
    if (name != list_of_series && !stepIn(name)) return strange(folder, name, "a series");
  }
  auto steps = readSeries((fs::path(folder) / list_of_series).string());
  if (!steps) return steps;
  std::erase_if(*steps, [&](const SeriesStep& step) { return stepIn(step.file).value_or(0) > from.step; });
  const bool has_step = !steps->empty() && stepIn(steps->back().file) == from.step;
  if (has_step && steps->back().time == from.time) return steps;
  return inputError(
      fmt::format("{}: its series has no step {} at time {}, which the checkpoint is of; name another folder",
                  folder, from.step, from.time));
}

/// The number of the next picture in a run that resumes from a checkpoint. Picture 1 is that of step 0.
struct NextFrame {
  std::uint64_t number = 1;
  bool is_there = false;  ///< whether the picture of the checkpoint itself exists, just before the next
};

/// Examines the folder of pictures of every `every` steps, which may be empty. Errors (input): it holds
/// something else, or not exactly the pictures up to this step.
Result<NextFrame> continueFrames(const std::string& folder, std::uint64_t step, std::uint64_t every) {
  VORPIPE_LET(names, namesIn(folder));
  const std::uint64_t own = 1 + step / every;
  if (names.empty()) return NextFrame{own, false};
  std::uint64_t last = 0;
  for (const std::string& name : names) {
    const auto number = numberIn(name, "frame-", ".png", 5);
    if (!number) return strange(folder, name, "numbered pictures");
    last = std::max(last, *number);
  }
  // The next picture may be of a step without a checkpoint: a run ended there, or before the checkpoint.
  if (last == own || last == own + 1) return NextFrame{own + 1, true};
  return inputError(fmt::format(
      "{}: its last picture is {}, where a run with --every {} has {} up to step {}; name another folder",
      folder, last, every, own, step));
}

/// Writes a checkpoint, whole or not at all.
Result<void> saveCheckpoint(const std::string& path, const FluidState& state, const FluidOptions& options) {
  VORPIPE_VAR(file, OutputFile::create(path));
  VORPIPE_TRY(writeFluid(file, state, options));
  return file.commit();
}

/// Draws the cells; with a free surface, the air is white.
Result<Image> drawFluid(Session& session, const FluidState& state, const FluidOptions& options,
                        const PictureOptions& picture, std::optional<view::FlowColor> color) {
  const view::FlowColor by = flowColorOf(state, picture, color);
  const bool by_flow = by != view::FlowColor::none;
  PictureOptions asked = picture;
  // Densities and speeds have scales and ranges like weights.
  if (by_flow) asked.render.color = ColorBy::weight;
  const Input input = inputOf(state, options);
  VORPIPE_VAR(render, pictureOf(asked, {}, input));
  render.search = options.search;
  VORPIPE_VAR(drawn, session.render(state.sites, by_flow ? view::ofWhiteCells(render) : render));
  if (by_flow) {
    auto colored = view::colorFlow(state, by, render, drawn.image);
    if (!colored) return tl::unexpected(std::move(colored.error()));
  }
  if (options.surface == Surface::free) whitenAir(state.sites, render, drawn.image, session.threads());
  return std::move(drawn.image);
}

}  // namespace

CellsOptions cellsOptionsOf(const FluidOptions& options) {
  CellsOptions cells{};
  cells.domain = options.domain;
  cells.outline = options.outline;
  cells.periodic = options.periodic;
  cells.search = options.search;
  return cells;
}

Input inputOf(const FluidState& state, const FluidOptions& options) {
  Input input{};
  input.sites = state.sites;
  input.domain = options.domain;
  input.outline = options.outline;
  input.periodic = options.periodic;
  return input;
}

view::FlowColor flowColorOf(const FluidState& state, const PictureOptions& picture,
                            std::optional<view::FlowColor> color) {
  if (picture.no_fill) return view::FlowColor::none;
  return color.value_or(view::usualFlowColor(state, picture.render.color));
}

Result<FluidRecord> FluidRecord::open(const FluidTargets& targets, const PictureOptions& picture,
                                      const FluidState* resumed) {
  auto trace = FluidTrace::open(targets.trace, resumed);
  if (!trace) return named("--trace", std::move(trace.error()));
  FluidRecord record(targets, picture, std::move(*trace));
  if (auto opened = record.openFrames(resumed); !opened) return named("--frames", std::move(opened.error()));
  if (auto opened = record.openSeries(resumed); !opened) return named("--series", std::move(opened.error()));
  return record;
}

Result<void> FluidRecord::openFrames(const FluidState* resumed) {
  const std::string& path = targets_->frames;
  if (path.empty()) return {};
  const bool is_continued = resumed != nullptr && lowerExtension(path) != view::film_extension;
  VORPIPE_LET(next, is_continued ? continueFrames(path, resumed->step, targets_->every) : NextFrame{});
  VORPIPE_VAR(recorder, is_continued ? view::openFrames(path, next.number) : view::openRecorder(path));
  recorder_ = std::move(recorder);
  first_is_drawn_ = next.is_there;
  return {};
}

Result<void> FluidRecord::openSeries(const FluidState* resumed) {
  const std::string& path = targets_->series;
  if (path.empty()) return {};
  if (resumed == nullptr) return createSeries(path);
  VORPIPE_VAR(steps, continueSeries(path, *resumed));
  series_ = std::move(steps);
  return {};
}

Result<void> FluidRecord::add(Session& session, const FluidState& state, const FluidOptions& options) {
  if (recorder_ && !std::exchange(first_is_drawn_, false)) {
    VORPIPE_LET(image, drawFluid(session, state, options, *picture_, targets_->color));
    VORPIPE_TRY(recorder_->add(image));
  }
  if (!targets_->series.empty()) {
    VORPIPE_TRY(addToSeries(session, state, options));
  }
  if (!targets_->checkpoint.empty()) return saveCheckpoint(targets_->checkpoint, state, options);
  return {};
}

Result<void> FluidRecord::addToSeries(Session& session, const FluidState& state,
                                      const FluidOptions& options) {
  CellsOptions polygons = cellsOptionsOf(options);
  polygons.detail = Detail::polygons;
  VORPIPE_LET(cells, session.cells(state.sites, polygons));
  const std::string name = seriesFileOf(state.step);
  VORPIPE_VAR(file, OutputFile::create((fs::path(targets_->series) / name).string()));
  VORPIPE_TRY(writeFluidStep(file, state, options, cells));
  VORPIPE_TRY(file.commit());
  if (series_.empty() || series_.back().file != name) series_.push_back({state.time, name});
  VORPIPE_VAR(list, OutputFile::create((fs::path(targets_->series) / "series.pvd").string()));
  VORPIPE_TRY(writeSeries(list, series_));
  return list.commit();
}

Result<void> FluidRecord::finish(RunLog& log) {
  VORPIPE_TRY(trace_.finish(log));
  return recorder_ ? recorder_->finish() : Result<void>();
}

Result<void> checkApart(const FluidTargets& targets, std::span<const OutputFile> files) {
  struct Folder {
    const char* option;
    fs::path path;
  };
  std::vector<Folder> folders;
  std::vector<fs::path> ends;
  for (const OutputFile& file : files) ends.emplace_back(file.target());
  const auto checkFile = [&](const char* option, const std::string& path) -> Result<void> {
    auto file = createOutputs(std::span(&path, 1), files);
    if (!file) return named(option, std::move(file.error()));
    ends.emplace_back(file->front().target());
    return {};
  };
  const bool is_film = lowerExtension(targets.frames) == view::film_extension;
  if (!targets.checkpoint.empty()) {
    VORPIPE_TRY(checkFile("--checkpoint", targets.checkpoint));
  }
  if (!targets.trace.empty()) {
    VORPIPE_TRY(checkFile("--trace", targets.trace));
  }
  if (is_film) {
    VORPIPE_TRY(checkFile("--frames", targets.frames));
  } else if (!targets.frames.empty()) {
    folders.push_back({"--frames", placeOf(targets.frames)});
  }
  if (!targets.series.empty()) folders.push_back({"--series", placeOf(targets.series)});
  if (folders.size() == 2 && folders[0].path == folders[1].path) {
    return inputError(fmt::format("--series: {} is the folder of --frames", targets.series));
  }
  for (const Folder& folder : folders) {
    const auto within = std::ranges::find(ends, folder.path, &fs::path::parent_path);
    if (within == ends.end()) continue;
    return inputError(
        fmt::format("{}: another output, {}, lies in this folder, which is to hold nothing else",
                    folder.option, within->filename().string()));
  }
  return {};
}

}  // namespace vorpipe::cli
