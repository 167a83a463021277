/// Large arrays that are written before they are read.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace vorpipe {

/// Has all threads ask the system for the pages of large memory, which it clears; otherwise the one that
/// writes to it first waits for them.
void clearPages(void* memory, std::size_t bytes, int threads);

/// Reserves memory for `size` elements of a vector, and its pages with clearPages(): for vectors that are
/// then filled completely.
template <class Vector>
void reserveAll(Vector& vector, std::size_t size, int threads) {
  vector.reserve(size);
  clearPages(vector.data(), size * sizeof(*vector.data()), threads);
}

/// An allocator that leaves elements uninitialized where no value is given.
template <class T>
struct BigAllocator {
  using value_type = T;
  BigAllocator() = default;
  template <class U>
  BigAllocator(const BigAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) { return std::allocator<T>().allocate(count); }
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

/// A vector whose new elements are uninitialized where no value is given.
template <class T>
using BigVector = std::vector<T, BigAllocator<T>>;

}  // namespace vorpipe
