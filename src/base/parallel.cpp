#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>

#if defined(VORPIPE_TELLS_TSAN)
#include <sanitizer/tsan_interface.h>
#endif

namespace vorpipe {
namespace {

/// Annotates a loop for the thread sanitizer (the preset tsan). Lives as long as the loop, which passes from
/// the thread that begins it to those that share it, and back. oneTBB passes it in code that is not compiled
/// for the sanitizer. Without annotations the sanitizer would report everything that a loop reads and writes
/// as races. It gets only this information: whatever precedes the loop precedes each range, and each range
/// precedes whatever follows the loop, or where it threw. Ranges have no order among each other, so races
/// between them are found. Does nothing in builds without the sanitizer.
class Handover {
 public:
#if defined(VORPIPE_TELLS_TSAN)
  Handover() { __tsan_release(&begun_); }
  ~Handover() { __tsan_acquire(&ended_); }
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;

  /// Lives as long as a range is computed.
  class Range {
   public:
    explicit Range(Handover& loop) : loop_(loop) { __tsan_acquire(&loop_.begun_); }
    ~Range() { __tsan_release(&loop_.ended_); }
    Range(const Range&) = delete;
    Range& operator=(const Range&) = delete;

   private:
    Handover& loop_;
  };

 private:
  char begun_ = 0, ended_ = 0;  ///< only their addresses are used
#else
  struct Range {
    explicit Range(Handover& /*loop*/) {}
  };
#endif
};

/// Returns the arena of `threads` threads in which this thread begins loops. Arenas are kept: oneTBB 2021
/// never frees some kilobytes of each, and long runs have millions of loops.
tbb::task_arena& arenaOf(int threads) {
  thread_local std::map<int, tbb::task_arena> arenas;
  tbb::task_arena& arena = arenas.try_emplace(threads, threads).first->second;
  if (arena.is_active()) return arena;
  try {
    arena.initialize();
  } catch (...) {
    arenas.erase(threads);  // an arena that got no memory waits for itself forever when it is used again
    throw;
  }
  return arena;
}

}  // namespace

void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body) {
  const std::size_t ranges = (count + grain - 1) / grain;
  Handover handover;
  const auto call = [&](std::size_t range) {
    const Handover::Range is_computed(handover);
    body(range * grain, std::min(count, (range + 1) * grain));
  };
  const auto running = std::min(static_cast<std::size_t>(threadCount(threads)), ranges);
  if (running <= 1) {
    for (std::size_t range = 0; range < ranges; ++range) call(range);
    return;
  }
  // More threads than processors only where a caller asks for them.
  using Control = tbb::global_control;
  constexpr auto most = Control::max_allowed_parallelism;
  const Control allowed(most, std::max(running, Control::active_value(most)));
  // A nested loop uses the same arena and takes no work of the outer loop while it waits.
  arenaOf(static_cast<int>(running)).execute([&] {
    tbb::this_task_arena::isolate(
        [&] { tbb::parallel_for(std::size_t{0}, ranges, call, tbb::simple_partitioner()); });
  });
}

void parallelSort(std::span<double> numbers, int threads) {
  const int running = threadCount(threadsForSteps(numbers.size(), threads));
  if (running <= 1) {
    std::ranges::sort(numbers);
    return;
  }
  tbb::task_arena(running).execute([&] { tbb::parallel_sort(numbers.begin(), numbers.end()); });
}

}  // namespace vorpipe
