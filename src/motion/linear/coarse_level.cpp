#include "motion/linear/coarse_level.h"

#include <algorithm>
#include <array>

#include "base/parallel.h"
#include "motion/linear/row_sum.h"

namespace vorpipe::moving {
namespace {

/// Rows of the coarse level made from the rows of one block of the fine level.
struct Made {
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
    becomePlaces(starts_);
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
void putRow(const RowSum& sum, std::size_t i, double extra, Made& made, Level& level) {
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
  level.diagonal[i] = static_cast<float>(diagonal);
  level.inverse[i] = diagonal > 0 ? static_cast<float>(1 / diagonal) : 0;
}

}  // namespace

void makeCoarse(const Level& fine, const std::vector<std::uint32_t>& starts, int threads, Level& coarse) {
  const std::size_t rows = starts.back(), blocks = starts.size() - 1;
  coarse.offsets.resize(rows + 1);
  for (auto part : {&coarse.before, &coarse.behind}) part->resize(rows);
  for (auto part : {&coarse.extra, &coarse.diagonal, &coarse.inverse}) part->resize(rows);
  std::vector<Made> made(blocks);
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
  std::vector<std::uint32_t> places(blocks + 1);
  for (std::size_t block = 0; block < blocks; ++block) {
    places[block] = static_cast<std::uint32_t>(made[block].columns.size());
  }
  becomePlaces(places);
  coarse.offsets[0] = 0;
  coarse.columns.resize(places.back());
  coarse.coupling.resize(places.back());
  parallelFor(blocks, 1, running, [&](std::size_t block, std::size_t) {
    for (auto i = starts[block]; i < starts[block + 1]; ++i) {
      for (auto place : {&coarse.before[i], &coarse.behind[i], &coarse.offsets[i + 1]})
        *place += places[block];
    }
    std::copy(made[block].columns.begin(), made[block].columns.end(), coarse.columns.begin() + places[block]);
    std::copy(made[block].coupling.begin(), made[block].coupling.end(),
              coarse.coupling.begin() + places[block]);
  });
  findBorder(coarse);
}

}  // namespace vorpipe::moving
