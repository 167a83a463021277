#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace vorpipe {

void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body) {
  const std::size_t ranges = (count + grain - 1) / grain;
  const auto call = [&](std::size_t range) { body(range * grain, std::min(count, (range + 1) * grain)); };
  const auto running = std::min(static_cast<std::size_t>(threadCount(threads)), ranges);
  if (running <= 1) {
    for (std::size_t range = 0; range < ranges; ++range) call(range);
    return;
  }
  // More threads than processors only where a caller asks for them.
  using Control = tbb::global_control;
  constexpr auto most = Control::max_allowed_parallelism;
  const Control allowed(most, std::max(running, Control::active_value(most)));
  tbb::task_arena(static_cast<int>(running)).execute([&] {
    tbb::parallel_for(std::size_t{0}, ranges, call, tbb::simple_partitioner());
  });
}

}  // namespace vorpipe
