#include "core/cell_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/pack.h"
#include "core/pieces.h"
#include "core/stopwatch.h"
#include "parallel.h"

namespace vorpipe {
namespace {

constexpr std::size_t lines_per_batch = std::size_t{1} << 21;
constexpr std::size_t most_neighbors = 1024;
constexpr std::size_t host_cells_at_once = std::size_t{1} << 15;
/// Fewer cells than this are clipped with room from the start: that costs less than a second pipeline.
constexpr std::size_t worth_fast_pipeline = std::size_t{1} << 15;

Error cancelled() { return {ErrorCode::cancelled, "interrupted"}; }

bool isDone(CellStatus status) { return status == CellStatus::certified || status == CellStatus::empty; }

}  // namespace

CellDrawing::CellDrawing(const DrawingInput& input)
    : input_(input), status_(input.sites.size(), CellStatus::missing) {}

Result<void> CellDrawing::draw(const View& view) {
  const bool first = view_ == nullptr;
  view_ = &view;
  return first ? searchAndDraw() : drawAgain();
}

Result<void> CellDrawing::searchAndDraw() {
  Indices pending(input_.sites.size());
  std::iota(pending.begin(), pending.end(), 0u);
  std::size_t k = input_.neighbors;
  for (;;) {
    auto unsecured = round(pending, k);
    if (!unsecured) return tl::unexpected(unsecured.error());
    const bool helped = 2 * unsecured->size() <= pending.size();
    pending = std::move(*unsecured);
    if (pending.empty()) break;
    if (!helped || 2 * k > most_neighbors || 2 * k > input_.backend.info().max_lines) {
      for_host_.insert(for_host_.end(), pending.begin(), pending.end());
      break;
    }
    k *= 2;
    retried_ += pending.size();
  }
  if (auto drawn = drawFromHost(); !drawn) return drawn;
  return checkOutsiders();
}

/// Draws the k nearest neighbors' cells, with more room where it is needed. Returns the cells that
/// want more neighbors; what else failed goes to for_host_.
Result<CellDrawing::Indices> CellDrawing::round(const Indices& which, std::size_t k) {
  const auto room = input_.sites.size() < worth_fast_pipeline ? Room::most : Room::fast;
  if (auto drawn = drawNeighbors(which, k, room, "cells"); !drawn) return tl::unexpected(drawn.error());
  if (room == Room::most) return afterRound(which);
  auto roomier = withStatus(which, CellStatus::overflow);
  const auto open = withStatus(which, CellStatus::open);
  roomier.insert(roomier.end(), open.begin(), open.end());
  retried_ += roomier.size();
  if (auto drawn = drawNeighbors(roomier, k, Room::most, "large cells"); !drawn) {
    return tl::unexpected(drawn.error());
  }
  return afterRound(which);
}

CellDrawing::Indices CellDrawing::afterRound(const Indices& which) {
  for (const auto site : which) {
    if (!isDone(status_[site]) && status_[site] != CellStatus::unsecured) for_host_.push_back(site);
  }
  return withStatus(which, CellStatus::unsecured);
}

Result<void> CellDrawing::drawNeighbors(const Indices& which, std::size_t k, Room room, const char* stage) {
  const auto at_once = entriesPerBatch(k);
  for (std::size_t begin = 0; begin < which.size(); begin += at_once) {
    if (auto go_on = report(stage, begin, which.size()); !go_on) return go_on;
    const auto count = std::min(at_once, which.size() - begin);
    Stopwatch watch;
    auto candidates = input_.search.neighbors(std::span(which).subspan(begin, count), k);
    search_seconds_ += watch.seconds();
    if (auto drawn = drawStep(candidates, room); !drawn) return drawn;
    if (input_.several_views) steps_.push_back({std::move(candidates), room});
  }
  return {};
}

Result<void> CellDrawing::drawStep(const Candidates& candidates, Room room) {
  const auto entries = candidates.site.size();
  for (std::size_t begin = 0, end = 0; begin < entries; begin = end) {
    const auto most_entries = input_.backend.info().max_entries;
    const auto most_lines = input_.backend.info().max_lines;
    while (end < entries && end - begin < most_entries &&
           candidates.first[end + 1] - candidates.first[begin] <= most_lines) {
      ++end;
    }
    packBatch(input_.sites, candidates, begin, end, input_.threads, batch_);
    if (auto drawn = drawBatch(batch_, std::span(candidates.site).subspan(begin, end - begin), room);
        !drawn) {
      return drawn;
    }
  }
  return {};
}

Result<void> CellDrawing::drawBatch(const CellBatch<float>& batch, std::span<const std::uint32_t> site,
                                    Room room) {
  const auto& box = view_->box;
  const Point center{0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)};
  const Point scale{2 / (box.xmax - box.xmin), 2 / (box.ymax - box.ymin)};
  marks_.resize(site.size());
  parallelFor(site.size(), 1 << 14, input_.threads, [&](std::size_t begin, std::size_t end) {
    for (auto e = begin; e < end; ++e) {
      const auto origin = cellOrigin(input_.sites, site[e]);
      marks_[e] = {static_cast<float>((origin.x - center.x) * scale.x),
                   static_cast<float>((origin.y - center.y) * scale.y), input_.sites.id[site[e]],
                   input_.shade[site[e]]};
    }
  });
  answers_.assign(site.size(), CellStatus::missing);
  Stopwatch watch;
  if (auto drawn = input_.backend.draw(batch, marks_, room, answers_); !drawn) return drawn;
  draw_seconds_ += watch.seconds();
  for (std::size_t e = 0; e < site.size(); ++e) status_[site[e]] = answers_[e];
  return {};
}

Result<void> CellDrawing::drawFromHost() {
  in_double_ += for_host_.size();
  for (std::size_t begin = 0; begin < for_host_.size(); begin += host_cells_at_once) {
    if (auto go_on = report("cells in double", begin, for_host_.size()); !go_on) return go_on;
    const auto count = std::min(host_cells_at_once, for_host_.size() - begin);
    Stopwatch watch;
    const auto cells = findCells(input_.sites, input_.search, input_.judge,
                                 std::span(for_host_).subspan(begin, count), input_.threads);
    search_seconds_ += watch.seconds();
    if (!cells) return tl::unexpected(cells.error());
    if (auto drawn = drawHostCells(*cells); !drawn) return drawn;
  }
  return {};
}

Result<void> CellDrawing::drawHostCells(const HostCells& cells) {
  const auto room_for = static_cast<std::size_t>(input_.backend.info().most_edges);
  Step step{{}, Room::most};
  Indices whole;
  Indices in_pieces;
  for (std::uint32_t e = 0; e < cells.candidates.site.size(); ++e) {
    if (cells.polygons.status[e] == CellStatus::empty) {
      status_[cells.candidates.site[e]] = CellStatus::empty;
      continue;
    }
    const auto begin = cells.candidates.first[e];
    const auto end = cells.candidates.first[e + 1];
    if (end - begin + 4 > room_for) {
      in_pieces.push_back(e);
      continue;
    }
    whole.push_back(e);
    auto& list = step.candidates;
    list.site.push_back(cells.candidates.site[e]);
    list.index.insert(list.index.end(), cells.candidates.index.begin() + begin,
                      cells.candidates.index.begin() + end);
    list.first.push_back(static_cast<std::uint32_t>(list.index.size()));
    list.reach.push_back(cells.candidates.reach[e]);
    list.walls.push_back(cells.candidates.walls[e]);
  }
  if (auto drawn = drawStep(step.candidates, step.room); !drawn) return drawn;
  for (const auto e : whole) {
    if (!isDone(status_[cells.candidates.site[e]])) in_pieces.push_back(e);
  }
  if (input_.several_views) steps_.push_back(std::move(step));
  return drawPieces(cells, in_pieces);
}

Result<void> CellDrawing::drawPieces(const HostCells& cells, const Indices& entries) {
  const auto edges = static_cast<std::size_t>(input_.backend.info().most_edges) - 4;
  Pieces pieces;
  const auto flush = [&]() -> Result<void> {
    if (pieces.site.empty()) return {};
    if (auto drawn = drawBatch(pieces.batch, pieces.site, Room::most); !drawn) return drawn;
    for (std::size_t piece = 0; piece < pieces.site.size(); ++piece) {
      if (answers_[piece] == CellStatus::certified) continue;
      return tl::unexpected(Error{ErrorCode::device, fmt::format("{} could not draw the cell of site {}",
                                                                 input_.backend.info().device.backend,
                                                                 input_.sites.id[pieces.site[piece]])});
    }
    for (const auto site : pieces.site) status_[site] = CellStatus::certified;
    if (input_.several_views) pieces_.push_back(std::move(pieces));
    pieces = {};
    return {};
  };
  for (const auto e : entries) {
    const auto site = cells.candidates.site[e];
    const auto begin = cells.polygons.first[e];
    const auto count = cells.polygons.first[e + 1] - begin;
    const auto& info = input_.backend.info();
    if (pieces.batch.lines.size() + 2 * count > std::min<std::uint64_t>(info.max_lines, lines_per_batch)) {
      if (auto drawn = flush(); !drawn) return drawn;
    }
    const auto added = appendPieces(std::span(cells.polygons.x).subspan(begin, count),
                                    std::span(cells.polygons.y).subspan(begin, count), edges, pieces.batch);
    pieces.site.insert(pieces.site.end(), added, site);
  }
  return flush();
}

/// A widened cell may reach into the domain where the cell itself does not; only a site outside the
/// domain can have an empty cell.
Result<void> CellDrawing::checkOutsiders() {
  const auto& sites = input_.sites;
  Indices outside;
  for (std::uint32_t site = 0; site < sites.size(); ++site) {
    const auto origin = cellOrigin(sites, site);
    const bool is_outside = origin.x != sites.x[site] || origin.y != sites.y[site];
    if (is_outside && status_[site] == CellStatus::certified) outside.push_back(site);
  }
  if (outside.empty()) return {};
  const auto cells = findCells(sites, input_.search, input_.judge, outside, input_.threads);
  if (!cells) return tl::unexpected(cells.error());
  for (std::size_t e = 0; e < cells->candidates.site.size(); ++e) {
    status_[cells->candidates.site[e]] =
        cells->polygons.status[e] == CellStatus::empty ? CellStatus::empty : CellStatus::certified;
  }
  return {};
}

Result<void> CellDrawing::drawAgain() {
  const auto known = status_;
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    if (auto go_on = report("drawing", s, steps_.size()); !go_on) return go_on;
    if (auto drawn = drawStep(steps_[s].candidates, steps_[s].room); !drawn) return drawn;
  }
  for (const auto& pieces : pieces_) {
    if (auto drawn = drawBatch(pieces.batch, pieces.site, Room::most); !drawn) return drawn;
  }
  status_ = known;
  return {};
}

Result<void> CellDrawing::report(const char* stage, std::size_t done, std::size_t of) const {
  if (!input_.progress) return {};
  const double fraction = static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(of, 1));
  if (input_.progress(stage, fraction)) return {};
  return tl::unexpected(cancelled());
}

std::size_t CellDrawing::entriesPerBatch(std::size_t lines_per_entry) const {
  const auto& info = input_.backend.info();
  const auto lines = std::min<std::uint64_t>(info.max_lines, lines_per_batch);
  const auto entries =
      std::min<std::uint64_t>(info.max_entries, lines / std::max<std::size_t>(lines_per_entry, 1));
  return std::max<std::size_t>(static_cast<std::size_t>(entries), 1);
}

CellDrawing::Indices CellDrawing::withStatus(const Indices& which, CellStatus status) const {
  Indices found;
  std::copy_if(which.begin(), which.end(), std::back_inserter(found),
               [&](std::uint32_t site) { return status_[site] == status; });
  return found;
}

}  // namespace vorpipe
