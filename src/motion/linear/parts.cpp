#include "motion/linear/parts.h"

#include <limits>

#include "base/block_sums.h"
#include "base/disjoint_sets.h"

namespace vorpipe::moving {

SingularParts SingularParts::of(const Laplacian& matrix, int threads) {
  const std::size_t rows = matrix.rows();
  DisjointSets sets(rows);
  forAll(rows, threads, [&](std::size_t i) {
    for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
      if (matrix.coupling[k] > 0) sets.join(static_cast<std::uint32_t>(i), matrix.columns[k]);
    }
  });
  std::vector<char> definite(rows, 0);
  for (std::size_t i = 0; i < matrix.extra.size(); ++i) {
    if (matrix.extra[i] > 0) definite[sets.root(static_cast<std::uint32_t>(i))] = 1;
  }
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  SingularParts parts;
  parts.part_of_.assign(rows, none);
  // The root of a part is its lowest row.
  for (std::size_t i = 0; i < rows; ++i) {
    const auto root = sets.root(static_cast<std::uint32_t>(i));
    if (definite[root] != 0) continue;
    if (root == i) {
      parts.part_of_[i] = static_cast<std::uint32_t>(parts.rows_.size());
      parts.rows_.push_back(0);
    } else {
      parts.part_of_[i] = parts.part_of_[root];
    }
    ++parts.rows_[parts.part_of_[i]];
  }
  return parts;
}

void SingularParts::removeMeans(std::vector<double>& values, int threads) const {
  if (count() == 1 && rows_.front() == values.size()) {
    const double mean =
        carefulSum(values.size(), threads, [&](std::size_t i) { return values[i]; }) / rows_.front();
    forAll(values.size(), threads, [&](std::size_t i) { values[i] -= mean; });
    return;
  }
  std::vector<CarefulSum> sums(count());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (part_of_[i] < count()) sums[part_of_[i]].add(values[i]);
  }
  std::vector<double> means(count());
  for (std::size_t part = 0; part < count(); ++part) means[part] = sums[part].value() / rows_[part];
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (part_of_[i] < count()) values[i] -= means[part_of_[i]];
  }
}

}  // namespace vorpipe::moving
