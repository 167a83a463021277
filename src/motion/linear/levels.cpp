#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "base/block_sums.h"
#include "motion/linear/multigrid.h"

namespace vorpipe::moving {
namespace {

/// Turns counts into start offsets; the last one becomes the sum.
void becomeStarts(std::vector<std::uint32_t>& counts) {
  std::uint32_t sum = 0;
  for (auto& count : counts) {
    const auto here = count;
    count = sum;
    sum += here;
  }
}

void resizeRows(Level& level, std::size_t rows) {
  for (auto* part : {&level.before, &level.behind}) part->resize(rows);
  for (auto* part : {&level.extra, &level.diagonal, &level.inverse}) part->resize(rows);
}

void setDiagonal(Level& level, std::size_t i, double sum) {
  level.diagonal[i] = static_cast<float>(sum);
  level.inverse[i] = sum > 0 ? static_cast<float>(1 / sum) : 0;
}

/// Sets the border of a level whose couplings are set.
void findBorder(Level& level) {
  level.border.clear();
  for (std::uint32_t i = 0; i < level.rows(); ++i) {
    if (level.before[i] > level.offsets[i]) level.border.push_back(i);
  }
}

/// Counts the nonzero couplings of each row. Returns the greatest number of the matrix.
double countCouplings(const Laplacian& matrix, int threads, std::vector<std::uint32_t>& counts) {
  counts.assign(matrix.rows() + 1, 0);
  const auto greatest = byBlocks<double>(matrix.rows(), threads, [&](std::size_t begin, std::size_t end) {
    double most = 0;
    for (auto i = begin; i < end; ++i) {
      if (!matrix.extra.empty()) most = std::max(most, matrix.extra[i]);
      for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
        most = std::max(most, matrix.coupling[k]);
        counts[i] += matrix.coupling[k] > 0;
      }
    }
    return most;
  });
  double most = 0;
  for (const double value : greatest) most = std::max(most, value);
  return most;
}

struct Unit {
  double inverse;

  [[nodiscard]] float of(double value) const {
    if (!(value > 0)) return 0;
    return std::max(static_cast<float>(value * inverse), std::numeric_limits<float>::min());
  }
};

/// Copies row i, in three parts.
void takeRow(const Laplacian& matrix, std::size_t i, Unit unit, Level& level) {
  const auto block = blockOf(i);
  std::uint32_t before = 0, other = 0;
  for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
    if (!(matrix.coupling[k] > 0)) continue;
    if (blockOf(matrix.columns[k]) != block) {
      ++other;
    } else if (matrix.columns[k] < i) {
      ++before;
    }
  }
  auto at_other = level.offsets[i], at = at_other + other, at_behind = at + before;
  level.before[i] = at;
  level.behind[i] = at_behind;
  level.extra[i] = matrix.extra.empty() ? 0 : unit.of(matrix.extra[i]);
  double sum = level.extra[i];
  for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
    if (!(matrix.coupling[k] > 0)) continue;
    const auto column = matrix.columns[k];
    auto& place = blockOf(column) != block ? at_other : column < i ? at : at_behind;
    const float coupling = unit.of(matrix.coupling[k]);
    level.columns[place] = column;
    level.coupling[place++] = coupling;
    sum += coupling;
  }
  setDiagonal(level, i, sum);
}

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
    std::vector<std::pair<std::size_t, std::uint32_t>> joining;
    for (auto i = begin_; i < end_; ++i) {
      if (level_.aggregate[i] == no_aggregate && !isLeftToSweeps(i)) joining.emplace_back(i, nearest(i));
    }
    for (const auto& [row, aggregate] : joining) {
      level_.aggregate[row] = aggregate != no_aggregate ? aggregate : count_++;
    }
    return count_;
  }

 private:
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
};

/// Sets the aggregate of each row as in Vanek, Mandel and Brezina (1996, algorithm 5.1), for each block
/// separately. A row and those strongly coupled to it form an aggregate, if none of them is taken. Each
/// remaining row joins the aggregate that it is coupled to most. A coupling is strong if it is more than
/// `strength` times the root of the product of both diagonals. A row whose extra far exceeds its couplings
/// has no aggregate: sweeps solve for it. Returns the first aggregate of each block, then the number of
/// aggregates.
std::vector<std::uint32_t> findAggregates(Level& level, float strength, int threads) {
  const std::size_t rows = level.rows();
  level.aggregate.resize(rows);
  std::vector<std::uint32_t> starts((rows + sweep_block - 1) / sweep_block + 1, 0);
  const int running = threadsForSteps(rows, threads);
  parallelFor(rows, sweep_block, running, [&](std::size_t begin, std::size_t end) {
    starts[blockOf(begin)] = Finder(level, strength, begin, end).find();
  });
  becomeStarts(starts);
  forAll(rows, threads, [&](std::size_t i) {
    if (level.aggregate[i] != no_aggregate) level.aggregate[i] += starts[blockOf(i)];
  });
  return starts;
}

/// Sums a row of a sparse matrix, in a hash table of columns. Nearby columns have nearby slots.
class RowSum {
 public:
  struct Entry {
    std::uint32_t column;
    double value;
  };

  RowSum() : slots_(128, none) {}

  void add(std::uint32_t column, double value) {
    auto& slot = slotOf(column);
    if (slot != none) {
      entries_[slot].value += value;
      return;
    }
    slot = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({column, value});
    if (entries_.size() * 2 > slots_.size()) grow();
  }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  void clear() {
    if (entries_.size() * 8 > slots_.size()) {
      slots_.assign(slots_.size(), none);
    } else {
      for (const auto& entry : entries_) {
        auto place = entry.column & (slots_.size() - 1);
        while (slots_[place] != none) {
          slots_[place] = none;
          place = (place + 1) & (slots_.size() - 1);
        }
      }
    }
    entries_.clear();
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  /// Returns where the entry of this column is noted, or the free slot for it.
  std::uint32_t& slotOf(std::uint32_t column) {
    auto place = column & (slots_.size() - 1);
    while (slots_[place] != none && entries_[slots_[place]].column != column) {
      place = (place + 1) & (slots_.size() - 1);
    }
    return slots_[place];
  }
  void grow() {
    slots_.assign(slots_.size() * 2, none);
    for (std::uint32_t k = 0; k < entries_.size(); ++k) slotOf(entries_[k].column) = k;
  }

  std::vector<std::uint32_t> slots_;
  std::vector<Entry> entries_;
};

/// Rows of the coarse level made from the rows of one block of the fine level.
struct BlockRows {
  std::vector<std::uint32_t> columns;
  std::vector<float> coupling;
};

/// The rows of a block, grouped by aggregate.
class Members {
 public:
  Members(const Level& fine, std::size_t begin, std::size_t end, std::uint32_t first, std::uint32_t last)
      : starts_(std::size_t{last} - first + 1), first_(first) {
    for (auto i = begin; i < end; ++i) {
      if (fine.aggregate[i] != no_aggregate) ++starts_[fine.aggregate[i] - first];
    }
    becomeStarts(starts_);
    rows_.resize(starts_.back());
    auto next = starts_;
    for (auto i = begin; i < end; ++i) {
      if (fine.aggregate[i] != no_aggregate) {
        rows_[next[fine.aggregate[i] - first]++] = static_cast<std::uint32_t>(i);
      }
    }
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t aggregate) const {
    const auto k = aggregate - first_;
    return {rows_.data() + starts_[k], rows_.data() + starts_[k + 1]};
  }

 private:
  std::vector<std::uint32_t> starts_, rows_;
  std::uint32_t first_;
};

/// Sums the couplings of an aggregate's rows. Returns their extras, including couplings to rows without an
/// aggregate.
double addUp(const Level& fine, std::uint32_t aggregate, std::span<const std::uint32_t> members,
             RowSum& sum) {
  sum.clear();
  double extra = 0;
  for (const auto i : members) {
    extra += fine.extra[i];
    for (auto k = fine.offsets[i]; k < fine.offsets[i + 1]; ++k) {
      const auto other = fine.aggregate[fine.columns[k]];
      if (other == aggregate) continue;
      if (other == no_aggregate) {
        extra += fine.coupling[k];
      } else {
        sum.add(other, fine.coupling[k]);
      }
    }
  }
  return extra;
}

/// Stores row i of a level in three parts; their offsets count from the start of the block's output.
void putRow(const RowSum& sum, std::size_t i, double extra, BlockRows& made, Level& level) {
  double diagonal = level.extra[i] = static_cast<float>(extra);
  const auto put = [&](const auto& belongs) {
    for (const auto& [column, value] : sum.entries()) {
      if (!belongs(column)) continue;
      const auto coupling = static_cast<float>(value);
      made.columns.push_back(column);
      made.coupling.push_back(coupling);
      diagonal += coupling;
    }
    return static_cast<std::uint32_t>(made.columns.size());
  };
  const auto block = blockOf(i);
  level.before[i] = put([&](std::uint32_t column) { return blockOf(column) != block; });
  level.behind[i] = put([&](std::uint32_t column) { return column < i && blockOf(column) == block; });
  level.offsets[i + 1] = put([&](std::uint32_t column) { return column > i && blockOf(column) == block; });
  setDiagonal(level, i, diagonal);
}

}  // namespace

void takeMatrix(const Laplacian& matrix, int threads, Level& level) {
  const std::size_t rows = matrix.rows();
  const double most = countCouplings(matrix, threads, level.offsets);
  becomeStarts(level.offsets);
  resizeRows(level, rows);
  level.columns.resize(level.offsets.back());
  level.coupling.resize(level.offsets.back());
  const Unit unit{most > 0 ? 1 / most : 1};
  forAll(rows, threads, [&](std::size_t i) { takeRow(matrix, i, unit, level); });
  findBorder(level);
}

bool makeCoarse(Level& fine, float strength, int threads, Level& coarse) {
  const auto starts = findAggregates(fine, strength, threads);
  if (starts.back() > fine.rows() / 10 * 9) return false;
  const std::size_t rows = starts.back(), blocks = starts.size() - 1;
  coarse.offsets.resize(rows + 1);
  resizeRows(coarse, rows);
  std::vector<BlockRows> made(blocks);
  const int running = threadsForSteps(fine.rows(), threads);
  parallelFor(fine.rows(), sweep_block, running, [&](std::size_t begin, std::size_t end) {
    const auto block = blockOf(begin);
    const Members members(fine, begin, end, starts[block], starts[block + 1]);
    RowSum sum;
    for (auto i = starts[block]; i < starts[block + 1]; ++i) {
      const double extra = addUp(fine, i, members.of(i), sum);
      putRow(sum, i, extra, made[block], coarse);
    }
  });
  std::vector<std::uint32_t> begins(blocks + 1);
  for (std::size_t block = 0; block < blocks; ++block) {
    begins[block] = static_cast<std::uint32_t>(made[block].columns.size());
  }
  becomeStarts(begins);
  coarse.offsets[0] = 0;
  coarse.columns.resize(begins.back());
  coarse.coupling.resize(begins.back());
  parallelFor(blocks, 1, running, [&](std::size_t block, std::size_t) {
    for (auto i = starts[block]; i < starts[block + 1]; ++i) {
      for (auto* at : {&coarse.before[i], &coarse.behind[i], &coarse.offsets[i + 1]}) *at += begins[block];
    }
    std::ranges::copy(made[block].columns, coarse.columns.begin() + begins[block]);
    std::ranges::copy(made[block].coupling, coarse.coupling.begin() + begins[block]);
  });
  findBorder(coarse);
  return true;
}

}  // namespace vorpipe::moving
