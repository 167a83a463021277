#include "motion/mass_matrix.h"

#include "base/block_sums.h"
#include "base/parallel.h"

namespace vorpipe::moving {

void massMatrix(const CellsThatMeet& meet, const EdgesOfCells& edges, int threads, Laplacian& matrix) {
  const std::size_t rows = meet.offsets.size() - 1;
  matrix.offsets.resize(rows + 1);
  const auto counts = [&](std::size_t i, std::uint64_t k) {
    return !isWall(meet.neighbors[k]) && static_cast<std::size_t>(meet.neighbors[k]) != i;
  };
  const auto forRow = [&](std::size_t i, const auto& each) {
    for (auto k = meet.offsets[i]; k < meet.offsets[i + 1]; ++k) {
      if (counts(i, k)) each(k);
    }
  };
  matrix.offsets[0] = 0;
  forAll(rows, threads, [&](std::size_t i) {
    std::uint64_t entries = 0;
    forRow(i, [&](std::uint64_t) { ++entries; });
    matrix.offsets[i + 1] = entries;
  });
  for (std::size_t i = 0; i < rows; ++i) matrix.offsets[i + 1] += matrix.offsets[i];
  matrix.columns.resize(matrix.offsets[rows]);
  matrix.coupling.resize(matrix.offsets[rows]);
  forAll(rows, threads, [&](std::size_t i) {
    auto out = matrix.offsets[i];
    forRow(i, [&](std::uint64_t k) {
      matrix.columns[out] = static_cast<std::uint32_t>(meet.neighbors[k]);
      matrix.coupling[out++] = edges.coupling[k];
    });
  });
  matrix.extra.resize(edges.arc.size());
  forAll(edges.arc.size(), threads, [&](std::size_t i) { matrix.extra[i] = edges.arc[i] / 2; });
}

}  // namespace vorpipe::moving
