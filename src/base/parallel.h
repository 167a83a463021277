/// Runs a loop on several threads (decision D73).
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <thread>

namespace vorpipe {

/// Returns the number of threads for a request of `threads`: the same, or all of the machine's for 0.
inline int threadCount(int threads) {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// The same for a loop of `steps` steps of a few nanoseconds: starting a thread costs as much as several
/// thousand of them.
inline int threadsForSteps(std::size_t steps, int threads) {
  constexpr std::size_t worth_a_thread = std::size_t{1} << 15;
  return steps < worth_a_thread ? 1 : threads;
}

/// The grain for a loop of `steps` steps: `most`, or less where the last ranges would otherwise leave threads
/// idle.
inline std::size_t grainFor(std::size_t steps, std::size_t most) {
  constexpr std::size_t enough_ranges = 8, least = 1024;
  return std::clamp(steps / enough_ranges, std::min(least, most), most);
}

/// Calls body(begin, end) for ranges of at most `grain` that cover [0, count), on up to `threads`
/// threads. The ranges do not depend on the number of threads. An exception of body is rethrown here, once
/// all threads have stopped.
void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls body(i) for each i in [0, count), in such ranges.
template <class Body>
void parallelEach(std::size_t count, std::size_t grain, int threads, const Body& body) {
  parallelFor(count, grain, threads, [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Sorts numbers in place, ascending, on up to `threads` threads; 0: all of the machine's. None is NaN.
void parallelSort(std::span<double> numbers, int threads);

}  // namespace vorpipe
