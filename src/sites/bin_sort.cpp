#include "sites/bin_sort.h"

#include <cassert>
#include <cmath>
#include <numeric>

#include "base/big_vector.h"
#include "base/parallel.h"
#include "sites/grid.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t least_block = std::size_t{1} << 15;
constexpr std::size_t most_blocks = 256;
/// A bucket is 2^11 bins or more: few enough buckets to write to all at once, small enough for a cache.
constexpr int least_bucket_bits = 11;
constexpr std::size_t most_buckets = 2048;
/// In a bin with more sites than this, equal positions are found by sorting.
constexpr std::size_t crowd = 24;

struct Placed {
  double x, y;
  std::uint32_t id, bin;
};

/// A stable counting sort in two passes, so that neither writes to more cache lines than the caches hold:
/// blocks of sites into buckets of bins, then each bucket into its bins.
class BinSorter {
 public:
  BinSorter(const Sites& sites, const PowerOfTwo& scale, int threads, SiteSet& set,
            std::vector<std::uint32_t>& owner, const BlockOfGrid& block)
      : sites_(sites),
        scale_(scale),
        threads_(threads),
        step_threads_(threadsForSteps(sites.size(), threads)),
        set_(set),
        owner_(owner),
        part_(block) {
    const auto bins = std::size_t{set.grid.columns} * set.grid.rows;
    while ((bins >> bucket_bits_) >= most_buckets) ++bucket_bits_;
    buckets_ = ((bins - 1) >> bucket_bits_) + 1;
    block_ = std::max(least_block, (sites.size() + most_blocks - 1) / most_blocks);
    blocks_ = (sites.size() + block_ - 1) / block_;
  }

  void run() {
    makeRoom();
    countBlocks();
    parallelFor(blocks_, 1, threads_, [&](std::size_t begin, std::size_t) { scatterBlock(begin); });
    removed_.resize(buckets_);
    parallelFor(buckets_, 1, step_threads_, [&](std::size_t begin, std::size_t) { sortBucket(begin); });
    closeGaps();
  }

 private:
  /// Page faults dominate here: allocates on all threads.
  void makeRoom() {
    const auto count = sites_.size();
    placed_.resize(count);
    parallelFor(4, 1, step_threads_, [&](std::size_t task, std::size_t) {
      if (task == 0) set_.x.resize(count);
      if (task == 1) set_.y.resize(count);
      if (task == 2) set_.id.resize(count);
      if (task == 3) {
        owner_.resize(count);
        std::iota(owner_.begin(), owner_.end(), 0u);
      }
    });
    set_.grid.offsets.resize(std::size_t{set_.grid.columns} * set_.grid.rows + 1);
  }

  template <class Each>
  void forBlock(std::size_t block, const Each& each) const {
    const auto end = std::min(sites_.size(), (block + 1) * block_);
    for (auto i = block * block_; i < end; ++i) {
      const double x = scale_(sites_.x[i]);
      const double y = scale_(sites_.y[i]);
      const auto bin = part_.whole == nullptr ? binOf(set_.grid, x, y) : binInBlock(x, y);
      each(Placed{x, y, static_cast<std::uint32_t>(i), bin});
    }
  }

  [[nodiscard]] std::uint32_t binInBlock(double x, double y) const {
    const Grid& whole = *part_.whole;
    const auto column = binAlong(x, whole.xmin, whole.size, whole.columns) - part_.west;
    const auto row = binAlong(y, whole.ymin, whole.size, whole.rows) - part_.south;
    assert(column < set_.grid.columns && row < set_.grid.rows);
    return row * set_.grid.columns + column;
  }

  /// Prefix sums: turns the number of sites of each block in each bucket into the slot of the first of them.
  void countBlocks() {
    places_.resize(blocks_ * buckets_);
    parallelFor(blocks_, 1, threads_, [&](std::size_t block, std::size_t) {
      auto* count = places_.data() + block * buckets_;
      forBlock(block, [&](const Placed& site) { ++count[site.bin >> bucket_bits_]; });
    });
    bucket_first_.resize(buckets_ + 1);
    std::uint32_t place = 0;
    for (std::size_t bucket = 0; bucket < buckets_; ++bucket) {
      bucket_first_[bucket] = place;
      for (std::size_t block = 0; block < blocks_; ++block) {
        auto& at = places_[block * buckets_ + bucket];
        place += std::exchange(at, place);
      }
    }
    bucket_first_[buckets_] = place;
  }

  void scatterBlock(std::size_t block) {
    auto* next = places_.data() + block * buckets_;
    forBlock(block, [&](const Placed& site) { placed_[next[site.bin >> bucket_bits_]++] = site; });
  }

  void sortBucket(std::size_t bucket) {
    const auto first_bin = bucket << bucket_bits_;
    const auto bins = std::min(std::size_t{1} << bucket_bits_, set_.grid.offsets.size() - 1 - first_bin);
    const auto begin = bucket_first_[bucket];
    const std::span<const Placed> sites(placed_.data() + begin, bucket_first_[bucket + 1] - begin);
    std::vector<std::uint32_t> next(bins + 1);
    for (const auto& site : sites) ++next[site.bin - first_bin + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::copy_n(next.begin(), bins, set_.grid.offsets.begin() + static_cast<std::ptrdiff_t>(first_bin));
    for (const auto& site : sites) {
      const auto place = begin + next[site.bin - first_bin]++;
      set_.x[place] = site.x;
      set_.y[place] = site.y;
      set_.id[place] = site.id;
    }
    removed_[bucket] = removeDuplicates(begin, {set_.grid.offsets.data() + first_bin, bins}, next);
  }

  /// Drops the duplicates in the bins of one bucket, whose sites begin at `begin`. first[b] and end[b] are
  /// the bounds of bin b relative to `begin`; updates `first`. Returns the number of duplicates.
  std::uint32_t removeDuplicates(std::size_t begin, std::span<std::uint32_t> first,
                                 std::span<const std::uint32_t> end) {
    std::uint32_t removed = 0;
    for (std::size_t bin = 0; bin < first.size(); ++bin) {
      const auto from = first[bin];
      first[bin] -= removed;
      const auto found = end[bin] - from > 1 ? noteDuplicates(begin + from, end[bin] - from) : 0;
      if (found == 0 && removed == 0) continue;
      for (auto place = begin + from; place < begin + end[bin]; ++place) {
        if (found > 0 && owner_[set_.id[place]] != set_.id[place]) {
          ++removed;
        } else {
          moveSite(place, place - removed);
        }
      }
    }
    return removed;
  }

  void moveSite(std::size_t from, std::size_t to) {
    set_.x[to] = set_.x[from];
    set_.y[to] = set_.y[from];
    set_.id[to] = set_.id[from];
  }

  /// Stores the owner of each duplicate among `count` sites of one bin; returns their number.
  std::uint32_t noteDuplicates(std::size_t begin, std::size_t count) {
    const auto found =
        count > crowd ? noteDuplicatesInCrowd(begin, count) : noteDuplicatesInPairs(begin, count);
    if (found > 0 && !sites_.weight.empty()) giveToHeaviest({set_.id.data() + begin, count});
    return found;
  }

  /// Makes the heaviest of equal positions their owner, which was the first of them.
  void giveToHeaviest(std::span<const std::uint32_t> ids) {
    for (const auto id : ids) {
      auto& heaviest = owner_[owner_[id]];
      if (sites_.weight[id] > sites_.weight[heaviest]) heaviest = id;
    }
    // The first one comes last, because the others read its entry.
    for (auto id = ids.rbegin(); id != ids.rend(); ++id) owner_[*id] = owner_[owner_[*id]];
  }

  /// Both of these make the lowest index the owner.
  std::uint32_t noteDuplicatesInPairs(std::size_t begin, std::size_t count) {
    std::uint32_t found = 0;
    for (auto place = begin + 1; place < begin + count; ++place) {
      for (auto other = begin; other < place; ++other) {
        if (set_.x[other] == set_.x[place] && set_.y[other] == set_.y[place]) {
          owner_[set_.id[place]] = set_.id[other];
          ++found;
          break;
        }
      }
    }
    return found;
  }

  std::uint32_t noteDuplicatesInCrowd(std::size_t begin, std::size_t count) {
    std::vector<Placed> order(count);
    for (std::size_t k = 0; k < count; ++k) {
      order[k] = {set_.x[begin + k], set_.y[begin + k], set_.id[begin + k], 0};
    }
    std::sort(order.begin(), order.end(), [](const Placed& a, const Placed& b) {
      return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.id < b.id;
    });
    std::uint32_t found = 0;
    for (std::size_t k = 1; k < count; ++k) {
      if (order[k].x != order[k - 1].x || order[k].y != order[k - 1].y) continue;
      owner_[order[k].id] = owner_[order[k - 1].id];
      ++found;
    }
    return found;
  }

  /// Moves the buckets together where duplicates were removed, and counts bins from the first site.
  void closeGaps() {
    auto& first = set_.grid.offsets;
    std::uint32_t removed = 0;
    for (std::size_t bucket = 0; bucket < buckets_; ++bucket) {
      const auto begin = bucket_first_[bucket];
      const auto end = bucket_first_[bucket + 1] - removed_[bucket];
      const auto first_bin = bucket << bucket_bits_;
      const auto last_bin = std::min(first_bin + (std::size_t{1} << bucket_bits_), first.size() - 1);
      for (auto bin = first_bin; bin < last_bin; ++bin) first[bin] += begin - removed;
      if (removed > 0) {
        for (auto place = begin; place < end; ++place) moveSite(place, place - removed);
      }
      removed += removed_[bucket];
    }
    const auto unique = sites_.size() - removed;
    first.back() = static_cast<std::uint32_t>(unique);
    set_.x.resize(unique);
    set_.y.resize(unique);
    set_.id.resize(unique);
  }

  const Sites& sites_;
  const PowerOfTwo& scale_;
  int threads_, step_threads_;
  SiteSet& set_;
  std::vector<std::uint32_t>& owner_;
  BlockOfGrid part_;
  int bucket_bits_ = least_bucket_bits;
  std::size_t buckets_ = 0, block_ = 0, blocks_ = 0;
  BigVector<Placed> placed_;                 ///< bucket by bucket
  std::vector<std::uint32_t> places_;        ///< of a block's next site of a bucket, by block and bucket
  std::vector<std::uint32_t> bucket_first_;  ///< of its sites; size: buckets + 1
  std::vector<std::uint32_t> removed_;       ///< duplicates by bucket
};

}  // namespace

PowerOfTwo::PowerOfTwo(int exponent)
    : first_(std::ldexp(1.0, exponent / 2)), second_(std::ldexp(1.0, exponent - exponent / 2)) {}

void orderByBins(const Sites& sites, const PowerOfTwo& scale, int threads, SiteSet& set,
                 std::vector<std::uint32_t>& owner, const BlockOfGrid& block) {
  BinSorter(sites, scale, threads, set, owner, block).run();
}

}  // namespace vorpipe::core
