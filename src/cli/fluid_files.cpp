#include "cli/fluid_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/parallel.h"
#include "base/try.h"
#include "cli/fluid_folders.h"
#include "cli/input.h"
#include "cli/picture.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/output_file.h"
#include "io/cells/fluid_state.h"
#include "view/flowing.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::cli {
namespace {

namespace fs = std::filesystem;

CellsOptions cellsOptions(const FluidOptions& options) {
  CellsOptions cells{};
  cells.domain = options.domain;
  cells.periodic = options.periodic;
  cells.search = options.search;
  cells.detail = Detail::polygons;
  return cells;
}

/// Returns the canonical path of a folder, even if it does not exist.
fs::path placeOf(const std::string& folder) {
  std::error_code none;
  // The appended file name makes a trailing slash irrelevant.
  return fs::weakly_canonical(fs::path(folder) / "file", none).parent_path();
}

}  // namespace

view::FlowColor flowColorOf(const FluidState& state, const PictureOptions& picture,
                            std::optional<view::FlowColor> color) {
  if (picture.no_fill) return view::FlowColor::none;
  return color.value_or(view::usualFlowColor(state, picture.render.color));
}

Result<Image> drawFluid(Session& session, const FluidState& state, const FluidOptions& options,
                        const PictureOptions& picture, std::optional<view::FlowColor> color) {
  const view::FlowColor by = flowColorOf(state, picture, color);
  const bool by_flow = by != view::FlowColor::none;
  PictureOptions asked = picture;
  // Densities and speeds have scales and ranges like weights.
  if (by_flow) asked.render.color = ColorBy::weight;
  Input input{};
  input.sites = state.sites;
  input.domain = options.domain;
  input.periodic = options.periodic;
  auto render = pictureOf(asked, {}, input);
  if (!render) return tl::unexpected(std::move(render.error()));
  render->search = options.search;
  auto drawn = session.render(state.sites, by_flow ? view::ofWhiteCells(*render) : *render);
  if (!drawn) return tl::unexpected(std::move(drawn.error()));
  if (by_flow) {
    auto colored = view::colorFlow(state, by, *render, drawn->image);
    if (!colored) return tl::unexpected(std::move(colored.error()));
  }
  if (options.surface == Surface::free) whitenAir(state.sites, *render, drawn->image, session.threads());
  return std::move(drawn->image);
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
  const bool goes_on = resumed != nullptr && lowerExtension(path) != ".mp4";
  const auto next = goes_on ? goOnWithFrames(path, resumed->step, targets_->every) : NextFrame{};
  if (!next) return tl::unexpected(next.error());
  auto recorder = goes_on ? view::openFrames(path, next->number) : view::openRecorder(path);
  if (!recorder) return tl::unexpected(std::move(recorder.error()));
  recorder_ = std::move(*recorder);
  first_is_drawn_ = next->is_there;
  return {};
}

Result<void> FluidRecord::openSeries(const FluidState* resumed) {
  const std::string& path = targets_->series;
  if (path.empty()) return {};
  if (resumed == nullptr) return cli::openSeries(path);
  auto steps = goOnWithSeries(path, *resumed);
  if (!steps) return tl::unexpected(std::move(steps.error()));
  series_ = std::move(*steps);
  return {};
}

Result<void> FluidRecord::add(Session& session, const FluidState& state, const FluidOptions& options) {
  if (recorder_ && !std::exchange(first_is_drawn_, false)) {
    const auto image = drawFluid(session, state, options, *picture_, targets_->color);
    if (!image) return tl::unexpected(image.error());
    VORPIPE_TRY(recorder_->add(*image));
  }
  if (!targets_->series.empty()) {
    VORPIPE_TRY(addToSeries(session, state, options));
  }
  if (!targets_->checkpoint.empty()) return saveCheckpoint(targets_->checkpoint, state, options);
  return {};
}

Result<void> FluidRecord::addToSeries(Session& session, const FluidState& state,
                                      const FluidOptions& options) {
  const auto cells = session.cells(state.sites, cellsOptions(options));
  if (!cells) return tl::unexpected(cells.error());
  const std::string name = seriesFileOf(state.step);
  auto file = OutputFile::create((fs::path(targets_->series) / name).string());
  if (!file) return tl::unexpected(std::move(file.error()));
  VORPIPE_TRY(writeFluidStep(*file, state, options, *cells));
  VORPIPE_TRY(file->commit());
  if (series_.empty() || series_.back().file != name) series_.push_back({state.time, name});
  auto list = OutputFile::create((fs::path(targets_->series) / "series.pvd").string());
  if (!list) return tl::unexpected(std::move(list.error()));
  VORPIPE_TRY(writeSeries(*list, series_));
  return list->commit();
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
  const bool is_film = lowerExtension(targets.frames) == ".mp4";
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

Result<void> saveCheckpoint(const std::string& path, const FluidState& state, const FluidOptions& options) {
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  VORPIPE_TRY(writeFluid(*file, state, options));
  return file->commit();
}

}  // namespace vorpipe::cli
