#include "picture/cell_drawing.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "backend/precision.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "cells/bisectors.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t batch_drawing_grain = std::size_t{1} << 14;

/// Limits the reach of a batch's cells so that float rounding loses no more than is allowed. A cell that is
/// not smaller becomes unsecured.
void boundReach(double allowed, int threads, CellBatch<float>& batch) {
  const auto most = static_cast<float>(2 * allowed / reach_rounding);
  for (auto& entry : batch.entries) entry.reach = std::min(entry.reach, most);
  parallelFor(batch.lines.size(), batch_drawing_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto l = begin; l < end; ++l) batch.lines[l].bound = std::min(batch.lines[l].bound, most);
  });
}

/// Fewer cells than this are clipped in the large pipeline from the start: that costs less than a second
/// pipeline.
constexpr std::size_t worth_fast_pipeline = std::size_t{1} << 15;

/// A large pipeline may draw what a small one does not; the fallback decides on cells without a shape.
/// Unsecured cells of lists stay so: more candidates may help.
void deferRest(Capacity capacity, bool are_lists, std::span<CellStatus> status) {
  for (auto& each : status) {
    if (each == CellStatus::certified || (are_lists && each == CellStatus::unsecured)) continue;
    each = capacity == Capacity::small ? CellStatus::overflow : CellStatus::open;
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
      palette_index_(palette_index),
      before_(before),
      what_(std::move(what)),
      upload_(input.backend, palette_index, &before.held),
      ladder_(input, upload_, worth_fast_pipeline),
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

/// Divides the cells between the device and the exact search. A device that draws no triangles only finds the
/// cells' statuses.
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
    VORPIPE_TRY(drawByDevice(view));
  }
  if (!as_polygons_.empty()) {
    const NeighborRows& cells = before_.known ? *before_.known : *before_.found_exactly;
    VORPIPE_TRY(drawPolygons(input_, palette_index_, view, as_polygons_, cells, draw_seconds_));
  }
  return giveAll();
}

/// Lets the device find and draw what it can.
Result<void> CellDrawing::drawByDevice(const View& view) {
  const auto by_grid = [&](const Tile&, auto which, Capacity capacity, auto status) -> Result<void> {
    const Stopwatch watch;
    VORPIPE_TRY(askToDraw(input_.backend, which, capacity, status));
    draw_seconds_ += watch.seconds();
    deferRest(capacity, false, status);
    return {};
  };
  const auto by_lists = [&](const Candidates& candidates, Capacity capacity, auto status) {
    return drawLists(view, candidates, capacity, status);
  };
  VORPIPE_LET(left, ladder_.run({by_grid, by_lists}));
  as_polygons_.insert(as_polygons_.end(), left.begin(), left.end());
  return searchExactly(left);
}

/// Draws every entry of `candidates`, in as many batches as the device needs. A list that is longer than a
/// batch stays missing. A cell so large that float rounding might visibly change it is unsecured.
Result<void> CellDrawing::drawLists(const View& view, const Candidates& candidates, Capacity capacity,
                                    std::span<CellStatus> status) {
  const auto& info = input_.backend.info();
  const auto entries = candidates.site.size();
  std::ranges::fill(status, CellStatus::missing);
  for (std::size_t begin = 0, end = 0; begin < entries; begin = end) {
    while (end < entries && end - begin < info.max_entries &&
           candidates.offsets[end + 1] - candidates.offsets[begin] <= info.max_lines) {
      ++end;
    }
    if (end == begin) {
      ++end;
      continue;
    }
    packBatch(input_.sites, candidates, begin, end, input_.threads, batch_);
    boundReach(lossAllowed(view, info.subpixel_bits), input_.threads, batch_);
    const auto count = end - begin;
    VORPIPE_TRY(drawBatch(view, std::span(candidates.site).subspan(begin, count), capacity,
                          status.subspan(begin, count)));
  }
  deferRest(capacity, true, status);
  return {};
}

Result<void> CellDrawing::drawBatch(const View& view, std::span<const std::uint32_t> site, Capacity capacity,
                                    std::span<CellStatus> status) {
  const auto& box = view.box;
  const Point center{0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)};
  const Point scale{2 / (box.xmax - box.xmin), 2 / (box.ymax - box.ymin)};
  marks_.resize(site.size());
  parallelFor(site.size(), batch_drawing_grain, input_.threads, [&](std::size_t begin, std::size_t end) {
    for (auto e = begin; e < end; ++e) {
      const auto origin = cellOrigin(input_.sites, site[e]);
      marks_[e] = {static_cast<float>(((origin.x - view.corner.x) - center.x) * scale.x),
                   static_cast<float>(((origin.y - view.corner.y) - center.y) * scale.y),
                   input_.sites.id[site[e]], palette_index_[site[e]]};
    }
  });
  const Stopwatch watch;
  VORPIPE_TRY(askToDraw(input_.backend, batch_, marks_, capacity, status));
  draw_seconds_ += watch.seconds();
  return {};
}

Result<void> CellDrawing::findStatuses() {
  return before_.known ? Result<void>{} : searchExactly(before_.triage->outside);
}

/// Finds the cells among these that the exact search has not found yet.
Result<void> CellDrawing::searchExactly(std::span<const std::uint32_t> which) {
  if (which.empty()) return {};
  auto& rows = before_.found_exactly;
  if (!rows) rows.emplace(input_.sites.size(), input_.threads);
  std::vector<std::uint32_t> open;
  std::ranges::copy_if(which, std::back_inserter(open),
                       [&](std::uint32_t site) { return !isDone(rows->status(site)); });
  VORPIPE_VAR(found_exactly, ladder_.askExactSearch(std::move(open)));
  for (std::size_t e = 0; e < found_exactly.which.size(); ++e) {
    before_.status[found_exactly.which[e]] = found_exactly.found.status(e);
  }
  rows->add(found_exactly.which, std::move(found_exactly.found));
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
  times.draw = 1e3 * draw_seconds_;
}

}  // namespace vorpipe::core
