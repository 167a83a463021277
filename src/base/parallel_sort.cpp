#include "base/parallel_sort.h"

#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "base/parallel.h"

namespace vorpipe {

void parallelSort(std::span<double> numbers, int threads) {
  const int running = threadCount(threadsForSteps(numbers.size(), threads));
  if (running <= 1) {
    std::ranges::sort(numbers);
    return;
  }
  tbb::task_arena(running).execute([&] { tbb::parallel_sort(numbers.begin(), numbers.end()); });
}

}  // namespace vorpipe
