#include "core/drawing/list_drawing.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/progress_steps.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t lines_per_batch = std::size_t{1} << 21;
/// Fewer cells than this are clipped with room from the start: that costs less than a second pipeline.
constexpr std::size_t worth_fast_pipeline = std::size_t{1} << 15;

}  // namespace

ListDrawing::ListDrawing(const Canvas& canvas, std::size_t neighbors, bool several_views,
                         const Progress& progress)
    : canvas_(canvas),
      neighbors_(neighbors),
      several_views_(several_views),
      progress_(progress),
      search_(canvas.sites, canvas.threads),
      drawing_(canvas) {}

Result<ListDrawing::Indices> ListDrawing::draw(const View& view, std::span<const std::uint32_t> which) {
  if (std::exchange(drawn_, true)) return drawAgain(view, which);
  const auto most = std::min<std::uint64_t>(FlannSearch::most_neighbors, canvas_.backend.info().max_lines);
  Indices pending(which.begin(), which.end());
  Indices left;
  for (auto k = std::min<std::size_t>(neighbors_, most);; k *= 2) {
    auto undrawn = round(view, pending, k);
    if (!undrawn) return tl::unexpected(undrawn.error());
    left.insert(left.end(), undrawn->other.begin(), undrawn->other.end());
    const bool helped = k < FlannSearch::usual_neighbors || 2 * undrawn->unsecured.size() <= pending.size();
    pending = std::move(undrawn->unsecured);
    if (pending.empty() || !helped || 2 * k > most) break;
    retried_ += pending.size();
  }
  left.insert(left.end(), pending.begin(), pending.end());
  return left;
}

/// Draws the k nearest neighbors' cells, with more room where it is needed.
Result<ListDrawing::Undrawn> ListDrawing::round(const View& view, const Indices& which, std::size_t k) {
  const auto effort = canvas_.sites.size() < worth_fast_pipeline ? Effort::roomy : Effort::fast;
  auto undrawn = drawNeighbors(view, which, k, effort, "cells");
  if (!undrawn || undrawn->roomier.empty()) return undrawn;
  retried_ += undrawn->roomier.size();
  const auto again = drawNeighbors(view, undrawn->roomier, k, Effort::roomy, "large cells");
  if (!again) return again;
  undrawn->unsecured.insert(undrawn->unsecured.end(), again->unsecured.begin(), again->unsecured.end());
  undrawn->other = again->other;
  return undrawn;
}

Result<ListDrawing::Undrawn> ListDrawing::drawNeighbors(const View& view, const Indices& which, std::size_t k,
                                                        Effort effort, const char* stage) {
  const auto& info = canvas_.backend.info();
  const auto lines = std::min<std::uint64_t>(info.max_lines, lines_per_batch);
  const auto at_once = std::clamp<std::size_t>(lines / k, 1, info.max_entries);
  Undrawn undrawn;
  const auto work = [&](std::size_t begin, std::size_t count) -> Result<void> {
    const Stopwatch watch;
    auto candidates = search_.neighbors(std::span(which).subspan(begin, count), k);
    search_seconds_ += watch.seconds();
    const auto status = drawing_.draw(view, candidates, effort);
    if (!status) return tl::unexpected(status.error());
    for (std::size_t e = 0; e < count; ++e) {
      const auto outcome = (*status)[e];
      if (outcome == CellStatus::certified) continue;
      auto& to = outcome == CellStatus::unsecured ? undrawn.unsecured
                 : effort == Effort::fast         ? undrawn.roomier
                                                  : undrawn.other;
      to.push_back(which[begin + e]);
    }
    if (several_views_) steps_.push_back({std::move(candidates), effort});
    return {};
  };
  if (auto done = runInSteps(progress_, stage, which.size(), at_once, work); !done) {
    return tl::unexpected(done.error());
  }
  return undrawn;
}

/// A cell may be in several steps; it is left if none of them draws it.
Result<ListDrawing::Indices> ListDrawing::drawAgain(const View& view, std::span<const std::uint32_t> which) {
  std::vector<bool> drawn(canvas_.sites.size());
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    if (auto go_on = reportProgress(progress_, "drawing", s, steps_.size()); !go_on)
      return tl::unexpected(go_on.error());
    const auto& candidates = steps_[s].candidates;
    const auto status = drawing_.draw(view, candidates, steps_[s].effort);
    if (!status) return tl::unexpected(status.error());
    for (std::size_t e = 0; e < candidates.site.size(); ++e) {
      if ((*status)[e] == CellStatus::certified) drawn[candidates.site[e]] = true;
    }
  }
  Indices left;
  std::copy_if(which.begin(), which.end(), std::back_inserter(left),
               [&](std::uint32_t site) { return !drawn[site]; });
  return left;
}

}  // namespace vorpipe::core
