#include "core/grid_drawing.h"

#include <utility>

#include "core/pace.h"

namespace vorpipe {
namespace {

/// Fewer cells than this are clipped with room from the start: that costs less than a second pipeline.
constexpr std::size_t worth_fast_pipeline = std::size_t{1} << 15;

}  // namespace

GridDrawing::GridDrawing(Backend& backend, Upload& upload, const SiteSet& sites, int threads,
                         const Progress& progress)
    : backend_(backend),
      upload_(upload),
      sites_(sites),
      threads_(threads),
      progress_(progress),
      roomy_(sites.size(), sites.size() < worth_fast_pipeline) {}

Result<GridDrawing::Indices> GridDrawing::draw(std::span<const std::uint32_t> which) {
  left_.clear();
  cells_ = which.size();
  done_ = 0;
  auto unfit =
      forTiles(sites_, backend_.info(), which, threads_, [&](const Tile& tile) { return drawTile(tile); });
  if (!unfit) return unfit;
  left_.insert(left_.end(), unfit->begin(), unfit->end());
  return std::move(left_);
}

Result<void> GridDrawing::drawTile(const Tile& tile) {
  if (auto given = upload_.give(tile); !given) return given;
  Indices fast;
  Indices roomy;
  for (const auto site : tile.own) (roomy_[tile.wholeIndex(site)] ? roomy : fast).push_back(site);
  const auto full = drawSites(fast, Effort::fast, "cells");
  if (!full) return tl::unexpected(full.error());
  retried_ += full->size();
  for (const auto site : *full) roomy_[tile.wholeIndex(site)] = true;
  roomy.insert(roomy.end(), full->begin(), full->end());
  const auto undrawn = drawSites(roomy, Effort::roomy, "large cells");
  if (!undrawn) return tl::unexpected(undrawn.error());
  for (const auto site : *undrawn) left_.push_back(tile.wholeIndex(site));
  done_ += tile.own.size();
  return {};
}

Result<GridDrawing::Indices> GridDrawing::drawSites(const Indices& which, Effort effort, const char* stage) {
  Indices undrawn;
  std::vector<CellStatus> status;
  const auto work = [&](std::size_t begin, std::size_t count) -> Result<void> {
    const auto part = std::span(which).subspan(begin, count);
    status.assign(count, CellStatus::missing);
    const Stopwatch watch;
    if (auto drawn = backend_.draw(part, effort, status); !drawn) return drawn;
    seconds_ += watch.seconds();
    for (std::size_t e = 0; e < count; ++e) {
      if (status[e] != CellStatus::certified) undrawn.push_back(part[e]);
    }
    return {};
  };
  const Stretch stretch{which.size(), done_, cells_};
  if (auto done = inSteps(progress_, stage, stretch, backend_.info().max_entries, work); !done) {
    return tl::unexpected(done.error());
  }
  return undrawn;
}

}  // namespace vorpipe
