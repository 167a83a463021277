#include "cli/runs/fluid_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/parallel.h"
#include "cli/runs/fluid_folders.h"
#include "cli/runs/input.h"
#include "cli/runs/picture.h"
#include "io/files/error.h"
#include "io/files/extension.h"
#include "io/files/output_file.h"
#include "io/fluid/fluid_state.h"

namespace vorpipe::cli {
namespace {

namespace fs = std::filesystem;

/// Whitens the pixels that are in no disc.
void clearAir(const Sites& sites, const RenderOptions& render, int threads, Image& image) {
  constexpr std::uint32_t white = 0xFFFFFFFF;
  const PictureFrame frame = frameOf(shownBox(render), image.width, image.height, render.fit);
  const Box& box = shownBox(render);
  const double dx = (box.xmax - box.xmin) / frame.width, dy = (box.ymax - box.ymin) / frame.height;
  parallelFor(static_cast<std::size_t>(image.height), 16, threads, [&](std::size_t begin, std::size_t end) {
    for (auto row = begin; row < end; ++row) {
      const double y = box.ymax - (static_cast<double>(row) - frame.top + 0.5) * dy;
      for (std::size_t column = 0; column < static_cast<std::size_t>(image.width); ++column) {
        const std::size_t k = row * static_cast<std::size_t>(image.width) + column;
        const std::uint32_t site = image.ids[k];
        if (site == no_site) continue;
        const double x = box.xmin + (static_cast<double>(column) - frame.left + 0.5) * dx;
        const double away = std::pow(x - sites.x[site], 2) + std::pow(y - sites.y[site], 2);
        if (away > sites.weight[site]) image.rgba[k] = white;
      }
    }
  });
}

CellsOptions cellsOptions(const FluidOptions& options) {
  CellsOptions cells{};
  cells.domain = options.domain;
  cells.periodic = options.periodic;
  cells.search = options.search;
  cells.detail = Detail::polygons;
  return cells;
}

}  // namespace

Result<Image> drawFluid(Session& session, const FluidState& state, const FluidOptions& options,
                        const PictureOptions& picture) {
  Input input{};
  input.sites = state.sites;
  input.domain = options.domain;
  input.periodic = options.periodic;
  auto render = pictureOf(picture, {}, input);
  if (!render) return tl::unexpected(std::move(render.error()));
  render->search = options.search;
  auto drawn = session.render(state.sites, *render);
  if (!drawn) return tl::unexpected(std::move(drawn.error()));
  if (options.surface == Surface::free) clearAir(state.sites, *render, session.threads(), drawn->image);
  return std::move(drawn->image);
}

std::string traceHead() {
  return "step,time,length,kinetic,potential,spring,energy,momentum_x,momentum_y,worst,farthest,diagrams,"
         "linear_iterations,halvings,seconds\n";
}

std::string traceRow(const FluidStep& step, bool with_times) {
  const std::string seconds = with_times ? fmt::format("{:.6f}", step.seconds) : std::string();
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", step.step, step.time, step.length,
                     step.kinetic, step.potential, step.spring, step.energy(), step.momentum.x,
                     step.momentum.y, step.worst, step.farthest, step.diagrams, step.linear_iterations,
                     step.halvings, seconds);
}

Result<FluidRecord> FluidRecord::open(const FluidTargets& targets, const PictureOptions& picture,
                                      const FluidState* resumed) {
  FluidRecord record(targets, picture);
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
    const auto image = drawFluid(session, state, options, *picture_);
    if (!image) return tl::unexpected(image.error());
    if (auto added = recorder_->add(*image); !added) return added;
  }
  if (!targets_->series.empty()) {
    if (auto added = addToSeries(session, state, options); !added) return added;
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
  if (auto written = writeFluidStep(*file, state, options, *cells); !written) return written;
  if (auto committed = file->commit(); !committed) return committed;
  if (series_.empty() || series_.back().file != name) series_.push_back({state.time, name});
  auto list = OutputFile::create((fs::path(targets_->series) / "series.pvd").string());
  if (!list) return tl::unexpected(std::move(list.error()));
  if (auto written = writeSeries(*list, series_); !written) return written;
  return list->commit();
}

Result<void> FluidRecord::finish() { return recorder_ ? recorder_->finish() : Result<void>(); }

Result<void> saveCheckpoint(const std::string& path, const FluidState& state, const FluidOptions& options) {
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  if (auto written = writeFluid(*file, state, options); !written) return written;
  return file->commit();
}

}  // namespace vorpipe::cli
