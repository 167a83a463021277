#include "motion/lacking_part.h"

#include <algorithm>

#include "base/block_sums.h"
#include "motion/linear/parts.h"

namespace vorpipe::moving {

LackingPart lackingPart(const Laplacian& matrix, std::span<const double> missing, int threads) {
  const SingularParts parts = SingularParts::of(matrix, threads);
  if (parts.count() < 2) return {};
  std::vector<CarefulSum> lacks(parts.count());
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const auto part = parts.partOf()[i];
    if (part < lacks.size()) lacks[part].add(missing[i]);
  }
  const auto most = std::ranges::max_element(lacks, {}, &CarefulSum::value);
  LackingPart lacking{{}, most->value()};
  for (std::uint32_t i = 0; i < missing.size(); ++i) {
    if (parts.partOf()[i] == static_cast<std::size_t>(most - lacks.begin())) lacking.cells.push_back(i);
  }
  return lacking;
}

double lackOf(std::span<const std::uint32_t> cells, std::span<const double> missing) {
  CarefulSum sum;
  for (const auto i : cells) sum.add(missing[i]);
  return sum.value();
}

}  // namespace vorpipe::moving
