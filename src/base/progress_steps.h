/// Runs a long stage in steps and reports progress between them.
#pragma once

#include <algorithm>

#include "base/stopwatch.h"
#include "base/try.h"
#include "vorpipe.h"

namespace vorpipe {

/// Calls progress(stage, done / of). Error (cancelled): it returned false.
inline Result<void> reportProgress(const Progress& progress, const char* stage, std::size_t done,
                                   std::size_t of) {
  const double fraction = static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(of, 1));
  if (!progress || progress(stage, fraction)) return {};
  return tl::unexpected(Error{ErrorCode::cancelled, "interrupted"});
}

/// Items done .. done + count - 1 of a stage of `of` items.
struct StageRange {
  std::size_t count, done, of;
};

/// Calls work(begin, count) for ranges that cover [0, range.count), each of at most `most`: small at first,
/// then as large as 0.2 s between two calls of progress permit. Results must not depend on the ranges.
template <class Work>
Result<void> runInSteps(const Progress& progress, const char* stage, const StageRange& range,
                        std::size_t most, const Work& work) {
  constexpr std::size_t first_step = std::size_t{1} << 15;
  constexpr double seconds_between = 0.2;
  auto step = std::min(first_step, most);
  for (std::size_t begin = 0; begin < range.count;) {
    VORPIPE_TRY(reportProgress(progress, stage, range.done + begin, range.of));
    const auto count = std::min(step, range.count - begin);
    const Stopwatch watch;
    VORPIPE_TRY(work(begin, count));
    begin += count;
    if (watch.seconds() < seconds_between / 4) step = std::min(4 * step, most);
    if (watch.seconds() > seconds_between) step = std::max<std::size_t>(step / 2, 1);
  }
  return {};
}

template <class Work>
Result<void> runInSteps(const Progress& progress, const char* stage, std::size_t count, std::size_t most,
                        const Work& work) {
  return runInSteps(progress, stage, StageRange{count, 0, count}, most, work);
}

}  // namespace vorpipe
