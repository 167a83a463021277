#include "core/drawing/grid_drawing.h"

#include <utility>

#include "base/progress_steps.h"
#include "core/judge/answers.h"
#include "core/search/sample.h"

namespace vorpipe::core {
namespace {

/// Fewer cells than this are clipped with room from the start: that costs less than a second pipeline.
constexpr std::size_t worth_fast_pipeline = std::size_t{1} << 15;

}  // namespace

GridDrawing::GridDrawing(Backend& backend, Upload& upload, const Judge& judge, const SiteSet& sites,
                         int threads, const Progress& progress)
    : backend_(backend),
      upload_(upload),
      judge_(judge),
      sites_(sites),
      threads_(threads),
      progress_(progress),
      roomy_(sites.size(), sites.size() < worth_fast_pipeline) {}

Result<GridDrawing::Indices> GridDrawing::draw(std::span<const std::uint32_t> which) {
  left_.clear();
  cells_ = which.size();
  done_ = 0;
  auto unfit = forTiles(
      sites_, backend_.info(), which, threads_, [&](const Tile& tile) { return drawTile(tile); },
      [&] { return judge_.areMany(left_.size()); });
  if (!unfit) return unfit;
  left_.insert(left_.end(), unfit->begin(), unfit->end());
  return std::move(left_);
}

Result<void> GridDrawing::drawTile(const Tile& tile) {
  if (judge_.areMany(left_.size())) {
    leave(tile, tile.own);
    return {};
  }
  if (auto given = upload_.give(tile); !given) return given;
  const Sample sample(tile.own);
  const auto before = left_.size();
  if (auto drawn = drawCells(tile, sample.cells); !drawn) return drawn;
  const auto failed = left_.size() - before;
  const bool left_to_judge =
      sample.isHopeless(failed) || judge_.areMany(left_.size() + sample.expected(failed));
  if (!left_to_judge) return drawCells(tile, sample.rest);
  leave(tile, sample.rest);
  return {};
}

void GridDrawing::leave(const Tile& tile, std::span<const std::uint32_t> which) {
  for (const auto site : which) left_.push_back(tile.wholeIndex(site));
  done_ += which.size();
}

Result<void> GridDrawing::drawCells(const Tile& tile, std::span<const std::uint32_t> which) {
  Indices fast;
  Indices roomy;
  for (const auto site : which) (roomy_[tile.wholeIndex(site)] ? roomy : fast).push_back(site);
  const auto full = drawSites(fast, Effort::fast, "cells");
  if (!full) return tl::unexpected(full.error());
  retried_ += full->size();
  for (const auto site : *full) roomy_[tile.wholeIndex(site)] = true;
  roomy.insert(roomy.end(), full->begin(), full->end());
  const auto undrawn = drawSites(roomy, Effort::roomy, "large cells");
  if (!undrawn) return tl::unexpected(undrawn.error());
  for (const auto site : *undrawn) left_.push_back(tile.wholeIndex(site));
  done_ += which.size();
  return {};
}

Result<GridDrawing::Indices> GridDrawing::drawSites(const Indices& which, Effort effort, const char* stage) {
  Indices undrawn;
  std::vector<CellStatus> status;
  const auto work = [&](std::size_t begin, std::size_t count) -> Result<void> {
    const auto part = std::span(which).subspan(begin, count);
    status.assign(count, CellStatus::missing);
    const Stopwatch watch;
    if (auto drawn = askToDraw(backend_, part, effort, status); !drawn) return drawn;
    seconds_ += watch.seconds();
    for (std::size_t e = 0; e < count; ++e) {
      if (status[e] != CellStatus::certified) undrawn.push_back(part[e]);
    }
    return {};
  };
  const StageRange stretch{which.size(), done_, cells_};
  if (auto done = runInSteps(progress_, stage, stretch, backend_.info().max_entries, work); !done) {
    return tl::unexpected(done.error());
  }
  return undrawn;
}

}  // namespace vorpipe::core
