/// Arrays of many numbers, in huge pages where the system has them: to touch such memory for the first time
/// takes a fraction of the page faults, and random access rarely has to look a page up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace vorpipe {

/// Asks for huge pages for memory that nobody has touched yet, if there is enough of it for one. What the
/// system makes of that changes no result. Memory that was freed and touched before is as good as it was: to
/// align arrays, or to take each from the system anew, costs more than huge pages save.
inline void askForHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
  constexpr std::uintptr_t page = 4096, huge_page = std::uintptr_t{1} << 21;
  if (bytes < huge_page) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const auto first = (begin + page - 1) / page * page;
  const auto end = (begin + bytes) / page * page;
  madvise(static_cast<char*>(memory) + (first - begin), end - first, MADV_HUGEPAGE);
#endif
}

/// Leaves elements that get no value as they are, and asks for huge pages.
template <class T>
struct BigAllocator {
  using value_type = T;
  BigAllocator() = default;
  template <class U>
  BigAllocator(const BigAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) {
    auto* memory = std::allocator<T>().allocate(count);
    askForHugePages(memory, count * sizeof(T));
    return memory;
  }
  void deallocate(T* memory, std::size_t count) noexcept { std::allocator<T>().deallocate(memory, count); }
  template <class U, class... Values>
  void construct(U* at, Values&&... values) {
    if constexpr (sizeof...(Values) == 0) {
      ::new (static_cast<void*>(at)) U;
    } else {
      ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
    }
  }
  friend bool operator==(const BigAllocator&, const BigAllocator&) { return true; }
};

/// A vector that is written before it is read: new elements without a value have any.
template <class T>
using BigVector = std::vector<T, BigAllocator<T>>;

/// Gives an empty vector room for `count` elements, in huge pages.
template <class T>
void reserveBig(std::vector<T>& vector, std::size_t count) {
  vector.reserve(count);
  askForHugePages(vector.data(), count * sizeof(T));
}

/// Gives an empty vector `count` elements, zero, in huge pages.
template <class T>
void makeBig(std::vector<T>& vector, std::size_t count) {
  reserveBig(vector, count);
  vector.resize(count);
}

}  // namespace vorpipe
