/// Keeps freed memory for later runs of the process (decision D61).
#pragma once

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace vorpipe {

/// From now on, this process keeps freed memory for reuse, on all threads alike. Otherwise glibc returns
/// arrays of some megabytes to the system after every run. Touching new memory for the first time then takes
/// up to a quarter of a run. Call at the start of main(): a library leaves this to its program.
inline void keepFreedMemory() {
#if defined(__GLIBC__)
  constexpr int never = -1;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, never);
  mallopt(M_ARENA_MAX, 1);
#endif
}

}  // namespace vorpipe
