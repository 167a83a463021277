/// Disjoint sets that several threads may join concurrently (Anderson and Woll 1991, "Wait-free parallel
/// algorithms for the union-find problem").
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

namespace vorpipe {

/// Sets of the numbers 0 to size - 1. The root of a set is its lowest number, independent of the order of
/// joins and of the number of threads: the parent of a number is never higher than the number.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    for (std::size_t i = 0; i < size; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }

  std::uint32_t root(std::uint32_t i) {
    for (;;) {
      const auto parent = at(i).load(std::memory_order_relaxed);
      if (parent == i) return i;
      const auto above = at(parent).load(std::memory_order_relaxed);
      // Other threads write here only numbers of the same set that are no higher than `parent`.
      if (above != parent) {
        auto expected = parent;
        at(i).compare_exchange_weak(expected, above, std::memory_order_relaxed);
      }
      i = above;
    }
  }

  void join(std::uint32_t a, std::uint32_t b) {
    for (;;) {
      a = root(a);
      b = root(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      auto expected = a;
      if (at(a).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
    }
  }

  /// Hands over the root of each number, once no thread joins any more.
  std::vector<std::uint32_t> roots() && {
    // The parent of a number is lower, so its own root is known.
    for (auto& parent : parent_) parent = parent_[parent];
    return std::move(parent_);
  }

 private:
  std::atomic_ref<std::uint32_t> at(std::uint32_t i) { return std::atomic_ref(parent_[i]); }

  std::vector<std::uint32_t> parent_;
};

}  // namespace vorpipe
