#include "base/big_vector.h"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <cstdint>

#include "base/parallel.h"

namespace vorpipe {

void clearPages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes,
                [[maybe_unused]] int threads) {
#ifdef MADV_POPULATE_WRITE
  constexpr std::size_t part = std::size_t{4} << 20;
  if (bytes < part || threadCount(threads) == 1) return;
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto first = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = (first + page - 1) / page * page, end = (first + bytes) / page * page;
  parallelFor(end - begin, part, threads, [begin](std::size_t from, std::size_t to) {
    // A hint: a system that does not take it clears pages later.
    (void)madvise(reinterpret_cast<void*>(begin + from), to - from, MADV_POPULATE_WRITE);
  });
#endif
}

}  // namespace vorpipe
