#include "motion/linear/aggregates.h"

#include <algorithm>

#include "base/block_sums.h"

namespace vorpipe::moving {
namespace {

/// Aggregates of one block.
class Finder {
 public:
  Finder(Level& level, float strength, std::size_t begin, std::size_t end)
      : level_(level), strength2_(strength * strength), begin_(begin), end_(end) {}

  /// Returns the number of aggregates, which are numbered from 0.
  std::uint32_t find() {
    for (auto i = begin_; i < end_; ++i) level_.aggregate[i] = no_aggregate;
    for (auto i = begin_; i < end_; ++i) {
      if (level_.aggregate[i] == no_aggregate && isRoot(i)) takeAround(i);
    }
    // All rows choose among the present aggregates, so that a joining row does not attract others.
    joining_.clear();
    for (auto i = begin_; i < end_; ++i) {
      if (level_.aggregate[i] == no_aggregate && !isLeftToSweeps(i)) joining_.push_back({i, nearest(i)});
    }
    for (const auto& [row, aggregate] : joining_) {
      level_.aggregate[row] = aggregate != no_aggregate ? aggregate : count_++;
    }
    return count_;
  }

 private:
  struct Joining {
    std::size_t row;
    std::uint32_t aggregate;
  };

  /// Calls each(column, coupling) for row i's couplings in the block, until that returns false.
  template <class Each>
  bool ofBlock(std::size_t i, const Each& each) const {
    for (auto k = level_.before[i]; k < level_.offsets[i + 1]; ++k) {
      if (!each(level_.columns[k], level_.coupling[k])) return false;
    }
    return true;
  }
  [[nodiscard]] bool isStrong(std::size_t i, std::uint32_t j, float coupling) const {
    return coupling * coupling > strength2_ * level_.diagonal[i] * level_.diagonal[j];
  }
  [[nodiscard]] bool isLeftToSweeps(std::size_t i) const {
    return level_.extra[i] >= 0.9f * level_.diagonal[i];
  }

  [[nodiscard]] bool isRoot(std::size_t i) const {
    if (isLeftToSweeps(i)) return false;
    bool any = false;
    const bool free = ofBlock(i, [&](std::uint32_t j, float coupling) {
      if (!isStrong(i, j, coupling)) return true;
      any = true;
      return level_.aggregate[j] == no_aggregate;
    });
    return free && any;
  }
  void takeAround(std::size_t i) {
    level_.aggregate[i] = count_;
    ofBlock(i, [&](std::uint32_t j, float coupling) {
      if (isStrong(i, j, coupling) && !isLeftToSweeps(j)) level_.aggregate[j] = count_;
      return true;
    });
    ++count_;
  }
  /// Returns none if no coupling is a good part of the total: a site among very many.
  [[nodiscard]] std::uint32_t nearest(std::size_t i) const {
    float most = 0.05f * level_.diagonal[i];
    auto nearest = no_aggregate;
    ofBlock(i, [&](std::uint32_t j, float coupling) {
      if (coupling > most && level_.aggregate[j] != no_aggregate) {
        most = coupling;
        nearest = level_.aggregate[j];
      }
      return true;
    });
    return nearest;
  }

  Level& level_;
  float strength2_;
  std::size_t begin_, end_;
  std::uint32_t count_ = 0;
  std::vector<Joining> joining_;
};

}  // namespace

std::vector<std::uint32_t> findAggregates(Level& level, float strength, int threads) {
  const std::size_t rows = level.rows();
  level.aggregate.resize(rows);
  std::vector<std::uint32_t> starts((rows + sweep_block - 1) / sweep_block + 1, 0);
  const int running = threadsForSteps(rows, threads);
  parallelFor(rows, sweep_block, running, [&](std::size_t begin, std::size_t end) {
    starts[blockOf(begin)] = Finder(level, strength, begin, end).find();
  });
  becomePlaces(starts);
  forAll(rows, threads, [&](std::size_t i) {
    if (level.aggregate[i] != no_aggregate) level.aggregate[i] += starts[blockOf(i)];
  });
  return starts;
}

}  // namespace vorpipe::moving
