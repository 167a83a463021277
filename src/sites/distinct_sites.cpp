#include "sites/distinct_sites.h"

#include <atomic>
#include <bit>
#include <numeric>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t distinct_grain = std::size_t{1} << 14;
constexpr std::uint32_t free_slot = ~std::uint32_t{0};

/// The owner of each position: a hash table into which several threads put sites concurrently.
class Positions {
 public:
  Positions(const SiteSet& set, const std::vector<double>& weight)
      : set_(set), weight_(weight), slots_(std::bit_ceil(2 * set.x.size()), free_slot) {}

  /// Makes a site the owner of its position if it is before the one that is. Returns whether there is one.
  bool put(std::uint32_t site) {
    for (auto slot = firstSlot(site);; slot = nextSlot(slot)) {
      const std::atomic_ref at(slots_[slot]);
      auto there = at.load(std::memory_order_relaxed);
      if (there == free_slot && at.compare_exchange_strong(there, site, std::memory_order_relaxed))
        return false;
      if (!isAt(site, there)) continue;
      while (isBefore(site, there) && !at.compare_exchange_weak(there, site, std::memory_order_relaxed)) {
      }
      return true;
    }
  }

  /// The owner of a position, of a site that is put.
  [[nodiscard]] std::uint32_t ownerAt(std::uint32_t site) const {
    auto slot = firstSlot(site);
    while (!isAt(site, slots_[slot])) slot = nextSlot(slot);
    return slots_[slot];
  }

 private:
  [[nodiscard]] bool isAt(std::uint32_t a, std::uint32_t b) const {
    return set_.x[a] == set_.x[b] && set_.y[a] == set_.y[b];
  }
  [[nodiscard]] bool isBefore(std::uint32_t a, std::uint32_t b) const {
    if (!weight_.empty() && weight_[a] != weight_[b]) return weight_[a] > weight_[b];
    return a < b;
  }

  [[nodiscard]] std::size_t firstSlot(std::uint32_t site) const {
    // Adding 0 turns -0 into 0. The factors are splitmix64's.
    auto mixed = std::bit_cast<std::uint64_t>(set_.x[site] + 0.0) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 32) ^ std::bit_cast<std::uint64_t>(set_.y[site] + 0.0)) * 0x94D049BB133111EBu;
    return (mixed ^ (mixed >> 32)) & (slots_.size() - 1);
  }
  [[nodiscard]] std::size_t nextSlot(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }

  const SiteSet& set_;
  const std::vector<double>& weight_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace

void keepDistinct(const Sites& sites, const PowerOfTwo& scale, int threads, SiteSet& set,
                  std::vector<std::uint32_t>& owner) {
  const auto count = sites.size();
  const int step_threads = threadsForSteps(count, threads);
  // Page faults dominate here: allocates on all threads.
  parallelFor(2, 1, step_threads, [&](std::size_t task, std::size_t) {
    if (task == 0) set.x.resize(count), set.id.resize(count);
    if (task == 1) set.y.resize(count), owner.resize(count);
  });
  parallelEach(count, distinct_grain, step_threads, [&](std::size_t i) {
    set.x[i] = scale(sites.x[i]);
    set.y[i] = scale(sites.y[i]);
    set.id[i] = owner[i] = static_cast<std::uint32_t>(i);
  });
  Positions positions(set, sites.weight);
  std::atomic<bool> any = false;
  parallelFor(count, distinct_grain, step_threads, [&](std::size_t begin, std::size_t end) {
    bool here = false;
    for (auto i = begin; i < end; ++i) here |= positions.put(static_cast<std::uint32_t>(i));
    if (here) any = true;
  });
  if (any) {
    parallelEach(count, distinct_grain, step_threads,
                 [&](std::size_t i) { owner[i] = positions.ownerAt(static_cast<std::uint32_t>(i)); });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (owner[i] != i) continue;
      set.x[kept] = set.x[i];
      set.y[kept] = set.y[i];
      set.id[kept++] = static_cast<std::uint32_t>(i);
    }
    set.x.resize(kept), set.y.resize(kept), set.id.resize(kept);
  }
  set.grid.columns = set.grid.rows = 1;
  set.grid.offsets = {0, static_cast<std::uint32_t>(set.x.size())};
}

}  // namespace vorpipe::core
