#include "cells/device_ladder.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/distinct.h"
#include "base/inside.h"
#include "base/parallel.h"
#include "base/progress_steps.h"
#include "base/stopwatch.h"
#include "base/try.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t device_eligible_grain = std::size_t{1} << 16;

bool fitsFloat(const SiteSet& sites, std::size_t i) {
  constexpr double most_distance = 1e15, most_weight = 1e18;
  return std::abs(sites.x[i]) <= most_distance && std::abs(sites.y[i]) <= most_distance &&
         (sites.weight.empty() || std::abs(sites.weight[i]) <= most_weight);
}

constexpr std::size_t lines_per_batch = std::size_t{1} << 20;

}  // namespace

Triage sortOut(const SiteSet& sites, int threads) {
  std::atomic<std::size_t> outside{0};
  std::atomic<bool> fit{true};
  parallelFor(sites.size(), device_eligible_grain, threads, [&](std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    bool all_fit = true;
    for (auto i = begin; i < end; ++i) {
      count += isInside(sites.domain, sites.x[i], sites.y[i]) ? 0u : 1u;
      all_fit = all_fit && fitsFloat(sites, i);
    }
    outside += count;
    if (!all_fit) fit = false;
  });
  if (!fit) return {{}, allOf(sites)};
  if (outside == 0) return {allOf(sites), {}};
  Triage triage;
  triage.inside.reserve(sites.size() - outside);
  triage.outside.reserve(outside);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    (isInside(sites.domain, sites.x[i], sites.y[i]) ? triage.inside : triage.outside).push_back(i);
  }
  return triage;
}

Result<void> Upload::give(const Tile& tile) {
  const bool all = tile.whole.empty();
  if (all && (has_all_ || (held_ != nullptr && held_->areThere()))) return {};
  const Stopwatch watch;
  if (!all && !palette_index_.empty()) {
    tile_palette_index_.clear();
    for (const auto site : tile.whole) tile_palette_index_.push_back(palette_index_[site]);
  }
  VORPIPE_TRY(backend_.upload(tile.sites, all ? palette_index_ : std::span(tile_palette_index_)));
  has_all_ = all;
  if (held_ != nullptr) {
    held_->after.reset();
    if (all && held_->uploads != nullptr) held_->after = *held_->uploads;
  }
  seconds_ += watch.seconds();
  return {};
}

CellLadder::CellLadder(const SearchInput& input, Upload& upload, std::size_t worth_fast)
    : input_(input),
      upload_(upload),
      begins_large_(input.sites.size() < worth_fast),
      any_large_(begins_large_),
      large_(input.sites.size(), begins_large_) {}

void CellLadder::choose(Triage triage) {
  sorted_out_ = true;
  on_device_ = std::move(triage.inside);
  left_ = std::move(triage.outside);
}

Result<std::vector<std::uint32_t>> CellLadder::run(const Ask& ask) {
  done_ = 0;
  // Cells that no device is asked about go to the remaining ones at once.
  if (!sorted_out_) choose(sortOut(input_.sites, input_.threads));
  const bool by_grid = input_.search.method == Search::grid;
  VORPIPE_TRY(by_grid ? runGrid(ask) : runLists(ask));
  sortDistinct(left_, static_cast<std::uint32_t>(input_.sites.size()));
  const auto kept = std::ranges::set_difference(on_device_, left_, on_device_.begin()).out;
  on_device_.erase(kept, on_device_.end());
  return std::exchange(left_, {});
}

Result<void> CellLadder::findLeft(const Indices& which, NeighborRows& rows) {
  if (which.empty()) return {};
  const Stopwatch watch;
  if (input_.exact_search.findAmong(which, input_.threads, rows)) {
    judge_seconds_ += watch.seconds();
    in_double_ += which.size();
    return {};
  }
  VORPIPE_VAR(rest, askExactSearch(which));
  rows.add(rest.which, std::move(rest.found));
  return {};
}

Result<CellResults> CellLadder::askExactSearch(Indices which) {
  const Stopwatch watch;
  VORPIPE_VAR(found,
              input_.exact_search.find(which, Precision::in_double, input_.threads, input_.progress, exact_));
  if (!which.empty()) judge_seconds_ += watch.seconds();
  in_double_ += which.size();
  return CellResults{std::move(which), std::move(found)};
}

Result<void> CellLadder::runGrid(const Ask& ask) {
  if (on_device_.empty()) return {};
  auto unfit = forTiles(input_.sites, input_.backend.info(), on_device_, input_.threads,
                        [&](const Tile& tile) { return tryTile(tile, ask); });
  if (!unfit) return tl::unexpected(unfit.error());
  any_large_ = any_large_ || retried_ > 0;
  left_.insert(left_.end(), unfit->begin(), unfit->end());
  return {};
}

Result<void> CellLadder::tryTile(const Tile& tile, const Ask& ask) {
  if (areMany(0)) {
    defer(tile, tile.own);
    return {};
  }
  VORPIPE_TRY(upload_.give(tile));
  const Sample sample(tile.own);
  const auto before = left_.size();
  hidden_ = 0;
  Large large;
  VORPIPE_TRY(tryFast(tile, sample.cells, ask, large));
  // A few cells that need more room do not change the sample's prediction.
  if (4 * large.cells.size() > sample.cells.size()) {
    VORPIPE_TRY(retryLarge(tile, ask, large));
  }
  const auto failed = left_.size() - before;
  if (sample.isHopeless(failed) || areMany(sample.expected(failed)) || sample.areMostlyHidden(hidden_)) {
    defer(tile, large.cells);
    defer(tile, sample.rest);
    return {};
  }
  VORPIPE_TRY(tryFast(tile, sample.rest, ask, large));
  return retryLarge(tile, ask, large);
}

/// Adds to `large` the cells that need more room, according to earlier tries or this one.
Result<void> CellLadder::tryFast(const Tile& tile, Which which, const Ask& ask, Large& large) {
  if (!any_large_) return tryCells(tile, which, Capacity::small, ask, large);
  Indices fast;
  for (const auto site : which) (large_[tile.wholeIndex(site)] ? large.cells : fast).push_back(site);
  return tryCells(tile, fast, Capacity::small, ask, large);
}

Result<void> CellLadder::retryLarge(const Tile& tile, const Ask& ask, Large& large) {
  const Large all = std::exchange(large, {});
  retried_ += all.overflowed;
  return tryCells(tile, all.cells, Capacity::large, ask, large);
}

Result<void> CellLadder::tryCells(const Tile& tile, Which which, Capacity capacity, const Ask& ask,
                                  Large& large) {
  const bool fast = capacity == Capacity::small;
  const auto before = large.cells.size();
  std::vector<CellStatus> status;
  const auto work = [&](std::size_t begin, std::size_t count) -> Result<void> {
    const auto part = which.subspan(begin, count);
    status.assign(count, CellStatus::missing);
    VORPIPE_TRY(ask.by_grid(tile, part, capacity, status));
    for (std::size_t e = 0; e < count; ++e) {
      hidden_ += status[e] == CellStatus::empty ? 1u : 0u;
      if (isDone(status[e])) continue;
      const auto site = tile.wholeIndex(part[e]);
      if (fast && status[e] == CellStatus::overflow) {
        large.cells.push_back(part[e]);
        ++large.overflowed;
        large_[site] = true;
      } else {
        left_.push_back(site);
      }
    }
    return {};
  };
  const StageRange range{which.size(), done_, on_device_.size()};
  const auto most = input_.backend.info().max_entries;
  VORPIPE_TRY(runInSteps(input_.progress, fast ? "cells" : "large cells", range, most, work));
  done_ += which.size() - (large.cells.size() - before);
  return {};
}

/// Whether so many cells remain, with `more` added, that triangulating all sites takes no longer than asking
/// the device about the rest.
bool CellLadder::areMany(std::size_t more) const {
  constexpr std::size_t many = 4;
  return many * (left_.size() + more) > input_.sites.size();
}

void CellLadder::defer(const Tile& tile, Which which) {
  for (const auto site : which) left_.push_back(tile.wholeIndex(site));
  done_ += which.size();
}

Result<void> CellLadder::runLists(const Ask& ask) {
  if (on_device_.empty()) return {};
  const Stopwatch watch;
  if (!lists_) lists_.emplace(input_.sites, input_.threads);
  search_seconds_ += watch.seconds();
  const auto most = std::min<std::uint64_t>(FlannSearch::most_neighbors, input_.backend.info().max_lines);
  const auto first = begins_large_ ? Capacity::large : Capacity::small;
  Indices pending = on_device_;
  for (auto k = std::min<std::size_t>(static_cast<std::size_t>(input_.search.neighbors), most);; k *= 2) {
    VORPIPE_VAR(outcome, tryLists(pending, k, first, ask));
    if (!outcome.overflowed.empty()) {
      retried_ += outcome.overflowed.size();
      VORPIPE_LET(again, tryLists(outcome.overflowed, k, Capacity::large, ask));
      outcome.unsecured.insert(outcome.unsecured.end(), again.unsecured.begin(), again.unsecured.end());
    }
    const bool helped = k < FlannSearch::usual_neighbors || 2 * outcome.unsecured.size() <= pending.size();
    pending = std::move(outcome.unsecured);
    if (pending.empty() || !helped || 2 * k > most) break;
    retried_ += pending.size();
  }
  left_.insert(left_.end(), pending.begin(), pending.end());
  return {};
}

Result<CellLadder::Outcome> CellLadder::tryLists(Which which, std::size_t k, Capacity capacity,
                                                 const Ask& ask) {
  const auto& info = input_.backend.info();
  const bool fast = capacity == Capacity::small;
  const auto lines = std::min<std::uint64_t>(info.max_lines, lines_per_batch);
  const auto at_once = std::clamp<std::size_t>(lines / k, 1, info.max_entries);
  Outcome outcome;
  std::vector<CellStatus> status;
  const auto work = [&](std::size_t begin, std::size_t count) -> Result<void> {
    const auto part = which.subspan(begin, count);
    const Stopwatch watch;
    const auto candidates = lists_->neighbors(part, k);
    search_seconds_ += watch.seconds();
    status.assign(count, CellStatus::missing);
    VORPIPE_TRY(ask.by_lists(candidates, capacity, status));
    for (std::size_t e = 0; e < count; ++e) {
      if (isDone(status[e])) continue;
      const bool again = fast && status[e] == CellStatus::overflow;
      (status[e] == CellStatus::unsecured ? outcome.unsecured
       : again                            ? outcome.overflowed
                                          : left_)
          .push_back(part[e]);
    }
    return {};
  };
  VORPIPE_TRY(runInSteps(input_.progress, fast ? "cells" : "large cells", which.size(), at_once, work));
  return outcome;
}

void CellLadder::describe(Report& report) const {
  report.retried += retried_;
  report.in_double += in_double_;
  report.exact += exact_;
  if (lists_) report.time_ms.search = std::max(report.time_ms.search, 0.0) + 1e3 * search_seconds_;
}

}  // namespace vorpipe::core
