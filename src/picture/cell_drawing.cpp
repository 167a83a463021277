#include "picture/cell_drawing.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"

namespace vorpipe::core {
namespace {

/// Fewer cells than this are clipped in the roomy pipeline from the start: that costs less than a second
/// pipeline.
constexpr std::size_t worth_fast_pipeline = std::size_t{1} << 15;

/// A roomy pipeline may draw what a fast one does not; the judge decides on cells without a shape.
void askForRoom(Effort effort, std::span<CellStatus> status) {
  for (auto& each : status) {
    if (each == CellStatus::certified) continue;
    each = effort == Effort::fast ? CellStatus::overflow : CellStatus::open;
  }
}

/// The same, except that more candidates may help.
void askForCandidates(Effort effort, std::span<CellStatus> status) {
  for (auto& each : status) {
    if (each == CellStatus::certified || each == CellStatus::unsecured) continue;
    each = effort == Effort::fast ? CellStatus::overflow : CellStatus::open;
  }
}

}  // namespace

bool isForDevices(const View& view) {
  constexpr double least = 0x1p-35;
  return std::min((view.box.xmax - view.box.xmin) / view.width,
                  (view.box.ymax - view.box.ymin) / view.height) >= least;
}

CellDrawing::CellDrawing(const SearchInput& input, std::span<const std::uint8_t> palette_index,
                         WhatToDraw what, DrawnBefore& before)
    : input_(input),
      before_(before),
      what_(std::move(what)),
      upload_(input.backend, palette_index, &before.held),
      ladder_(input, upload_, worth_fast_pipeline),
      batches_({input.backend, input.sites, palette_index, input.threads}),
      polygons_({input.backend, input.sites, palette_index, input.threads}),
      pixels_(input.sites, palette_index, input.threads) {
  if (before_.status.empty()) {
    before_.status.assign(input.sites.size(), CellStatus::certified);
    if (before_.known) {
      for (std::size_t i = 0; i < before_.status.size(); ++i) before_.status[i] = before_.known->status(i);
    }
  }
  if (before_.known) {
    as_polygons_ = what_.shown ? *what_.shown : allOf(input.sites);
  } else {
    choose();
  }
}

/// Divides the cells between the device and the judge. A device that draws no triangles only finds the cells'
/// statuses.
void CellDrawing::choose() {
  if (!before_.triage) before_.triage = sortOut(input_.sites, input_.threads);
  const Triage& all = *before_.triage;
  Triage chosen{{}, all.outside};
  const bool needed = input_.backend.info().has_vertices || !(what_.shown || before_.done);
  if (what_.shown) {
    auto& to = what_.by_device ? chosen.inside : chosen.outside;
    std::ranges::set_difference(*what_.shown, all.outside, std::back_inserter(to));
    std::ranges::sort(chosen.outside);
  } else {
    chosen.inside = all.inside;
  }
  if (!needed) chosen.inside.clear();
  ladder_.choose(std::move(chosen));
}

Result<void> CellDrawing::draw(const View& view) {
  VORPIPE_TRY(giveAll());
  VORPIPE_TRY(input_.backend.begin(view));
  if (!before_.known) {
    VORPIPE_TRY(climb(view));
  }
  if (!as_polygons_.empty()) {
    const NeighborRows& cells = before_.known ? *before_.known : *before_.judged;
    VORPIPE_TRY(polygons_.draw(view, as_polygons_, cells, input_.progress));
  }
  return giveAll();
}

/// Lets the device find and draw what it can.
Result<void> CellDrawing::climb(const View& view) {
  const auto by_grid = [&](const Tile&, auto which, Effort effort, auto status) -> Result<void> {
    const Stopwatch watch;
    VORPIPE_TRY(askToDraw(input_.backend, which, effort, status));
    grid_seconds_ += watch.seconds();
    askForRoom(effort, status);
    return {};
  };
  const auto by_lists = [&](const Candidates& candidates, Effort effort, auto status) -> Result<void> {
    const auto drawn = batches_.draw(view, candidates, effort);
    if (!drawn) return tl::unexpected(drawn.error());
    std::ranges::copy(*drawn, status.begin());
    askForCandidates(effort, status);
    return {};
  };
  const auto left = ladder_.run({by_grid, by_lists});
  if (!left) return tl::unexpected(left.error());
  as_polygons_.insert(as_polygons_.end(), left->begin(), left->end());
  return judge(*left);
}

Result<void> CellDrawing::findStatuses() {
  return before_.known ? Result<void>{} : judge(before_.triage->outside);
}

/// Finds the cells among these that the judge has not found yet.
Result<void> CellDrawing::judge(std::span<const std::uint32_t> which) {
  if (which.empty()) return {};
  auto& rows = before_.judged;
  if (!rows) rows.emplace(input_.sites.size(), input_.threads);
  std::vector<std::uint32_t> open;
  std::ranges::copy_if(which, std::back_inserter(open),
                       [&](std::uint32_t site) { return !isDone(rows->status(site)); });
  auto judged = ladder_.askJudge(std::move(open));
  if (!judged) return tl::unexpected(judged.error());
  for (std::size_t e = 0; e < judged->which.size(); ++e) {
    before_.status[judged->which[e]] = judged->found.status(e);
  }
  rows->add(judged->which, std::move(judged->found));
  return {};
}

Result<void> CellDrawing::read(const View& view, std::span<std::uint32_t> rgba,
                               std::span<std::uint32_t> ids) {
  VORPIPE_TRY(input_.backend.read(rgba, ids));
  pixels_.apply(before_.status, view.palette, rgba, ids);
  return {};
}

/// With any search, a backend may use all sites when it begins or finishes a picture, except for triangles
/// alone.
Result<void> CellDrawing::giveAll() {
  if (before_.known && input_.backend.info().has_vertices) return {};
  return fits(input_.sites, input_.backend.info()) ? upload_.give({input_.sites, {}, {}}) : Result<void>{};
}

void CellDrawing::describe(Report& report) const {
  ladder_.describe(report);
  auto& times = report.time_ms;
  const auto add = [](double seconds, double& to) { to = std::max(to, 0.0) + 1e3 * seconds; };
  add(upload_.seconds(), times.upload);
  if (ladder_.judgeSeconds() > 0) add(ladder_.judgeSeconds(), times.cells);
  times.draw = 1e3 * (polygons_.seconds() + batches_.seconds() + grid_seconds_);
}

}  // namespace vorpipe::core
