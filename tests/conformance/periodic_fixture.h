/// Sessions of a backend for the tests of periodic domains.
#pragma once

#include <string>
#include <vector>

#include "conformance/cells_fixture.h"
#include "conformance/tiled_cells.h"

namespace vorpipe::test {

using Lines = std::vector<std::string>;

inline CellsOptions repeated(Periodic periodic, const Box& domain = unit,
                             Detail detail = Detail::everything) {
  CellsOptions wanted{};
  wanted.domain = domain;
  wanted.periodic = periodic;
  wanted.detail = detail;
  return wanted;
}

class PeriodicCells : public Cells {
 protected:
  /// Computes the cells, and expects that check() finds no broken promise.
  static Diagram expectRight(const Sites& sites, const CellsOptions& wanted) {
    auto diagram = cells(sites, wanted);
    const auto broken = check(sites, wanted, diagram);
    EXPECT_EQ(broken.value_or(Lines{"no memory"}), Lines{});
    EXPECT_EQ(diagram.neighbor_shifts.size(), diagram.neighbors.size());
    EXPECT_TRUE(diagram.triangles.empty());
    return diagram;
  }
};

/// n random sites with weights from 0 to `spacings` / n, most of them small; 1 / n is the mean spacing
/// squared.
inline Sites weighted(std::uint64_t n, std::uint64_t seed, double spacings) {
  auto sites = generate(Pattern::random, n, seed);
  const auto parts = generate(Pattern::random, n, seed + 100).x;
  for (const double part : parts) sites.weight.push_back(spacings / static_cast<double>(n) * part * part);
  return sites;
}

}  // namespace vorpipe::test
