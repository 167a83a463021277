/// What one cell of those side by side has to try. See lane_words.h.
#pragma once

#include "backend/cpu/lane_clip.h"

namespace vorpipe::cpu {
namespace {
namespace lanes {

/// Sites to try, for one cell.
struct Feed {
  struct Run {
    int place, end;
  };
  Run run[8];
  int next, runs;
  int count;

  void clear() { next = runs = count = 0; }
  void add(int place, int end) {
    if (place >= end) return;
    run[runs++] = {place, end};
    count += end - place;
  }
  /// The next site, or `none` after the last.
  int take(int none) {
    if (next == runs) return none;
    auto& now = run[next];
    const int place = now.place++;
    if (now.place == now.end) ++next;
    return place;
  }
};

/// What differs from cell to cell and is not geometry.
struct Lane {
  static constexpr std::size_t most_hits = 16;

  double site_x, site_y, weight;
  int self, column, row, tried;
  Walk<Single>::Bins bins;
  bool unknown;
  bool done;  ///< no bins are left to try
  Feed feed;
  std::size_t hits;
  int hit[most_hits];

  void feedBlock(Walk<Single>& walk) {
    feed.clear();
    for (int r = 0; r < BLOCK_RUNS; ++r) {
      const auto span = walk.sitesOf(bins, walk.partOfBlock(bins, r, column, row));
      feed.add(span.first, span.behind);
    }
  }

  void feedStep(Walk<Single>& walk, const Walk<Single>::BinRange& range, int step) {
#ifdef WEIGHTED
    if (step < 0) {
      for (int k = (-1 - step) * MOST_RUNS; k < min(-step * MOST_RUNS, bins.heavy); ++k) {
        feed.add(walk.heavyAt(k), walk.heavyAt(k) + 1);
      }
      return;
    }
#endif
    for (int r = 0; r < MOST_RUNS; ++r) {
      const auto part = walk.partOfStep(range, step, r, column, row);
      if (part.from > part.to) continue;
      const auto span = walk.sitesOf(bins, part);
      feed.add(span.first, span.behind);
    }
  }
};

}  // namespace lanes
}  // namespace
}  // namespace vorpipe::cpu
