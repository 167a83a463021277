#include "backend/cpu/tree_cells.h"

#include "backend/collect.h"

namespace vorpipe::cpu {

void findInDouble(const SiteSet& sites, const SiteTree& tree, std::span<const std::uint32_t> which,
                  int threads, CellNeighbors& out) {
  collect(which.size(), threads, out, [&] {
    return [&, finder = std::make_unique<CellFinder<double>>(sites, tree)](
               std::size_t e, std::vector<std::int32_t>& neighbors) {
      return finder->find(which[e], neighbors, false);
    };
  });
}

}  // namespace vorpipe::cpu
