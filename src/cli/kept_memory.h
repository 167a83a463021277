/// How a program keeps the memory of its runs (decision D61).
#pragma once

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace vorpipe {

/// From now on this process keeps memory that it frees for what it needs next, on all threads alike. Else
/// glibc gives arrays of some megabytes back to the system with every run and gets them anew, and to touch
/// new memory for the first time takes up to a quarter of a run. For the start of main(): a library leaves
/// that to its program.
inline void keepFreedMemory() {
#if defined(__GLIBC__)
  constexpr int never = -1;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, never);
  mallopt(M_ARENA_MAX, 1);
#endif
}

}  // namespace vorpipe
