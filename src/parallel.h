/// Runs a loop on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace vorpipe {

/// Threads to use for a request of `threads`: itself, or all of the machine's for 0.
inline int threadCount(int threads) {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// The same for a loop of so many steps that take some nanoseconds each: a few thousand are done before
/// another thread has begun.
inline int threadsForSteps(std::size_t steps, int threads) {
  constexpr std::size_t worth_a_thread = std::size_t{1} << 15;
  return steps < worth_a_thread ? 1 : threads;
}

/// How many of so many steps go into one range: `most`, but less where threads would then wait for one
/// another.
inline std::size_t grainFor(std::size_t steps, std::size_t most) {
  constexpr std::size_t enough_ranges = 8, least = 1024;
  return std::clamp(steps / enough_ranges, std::min(least, most), most);
}

/// Calls body(begin, end) for ranges of at most `grain` that cover [0, count), on up to `threads`
/// threads. The ranges do not depend on the number of threads. What body throws is thrown here, once
/// all threads have stopped.
template <class Body>
void parallelFor(std::size_t count, std::size_t grain, int threads, const Body& body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr thrown;
  std::once_flag once;
  auto work = [&] {
    try {
      for (std::size_t begin; (begin = next.fetch_add(grain)) < count;) {
        body(begin, std::min(count, begin + grain));
      }
    } catch (...) {
      next = count;
      std::call_once(once, [&] { thrown = std::current_exception(); });
    }
  };
  const auto ranges = (count + grain - 1) / grain;
  const auto helpers = std::min<std::size_t>(static_cast<std::size_t>(threadCount(threads)), ranges);
  {
    std::vector<std::jthread> running;
    for (std::size_t t = 1; t < helpers; ++t) running.emplace_back(work);
    work();
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace vorpipe
