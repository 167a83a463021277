#include "backend/cpu/exact_cells.h"

#include <optional>

#include "backend/collect.h"
#include "backend/cpu/double_double.h"
#include "backend/cpu/long_cells.h"
#include "backend/cpu/tree_cells.h"

namespace vorpipe::cpu {

namespace {

/// Tries numbers of more and more bits.
class ExactFinder {
 public:
  ExactFinder(const SiteSet& sites, const SiteTree& tree) : sites_(sites), tree_(tree), short_(sites, tree) {}

  CellStatus find(std::uint32_t site, std::vector<std::int32_t>& neighbors) {
    const auto status = short_.find(site, neighbors, false);
    if (status != CellStatus::open) return status;
    if (!long_) long_.emplace(sites_, tree_);
    return long_->find(site, neighbors);
  }

 private:
  const SiteSet& sites_;
  const SiteTree& tree_;
  CellFinder<DoubleDouble> short_;
  std::optional<LongFinder> long_;
};

}  // namespace

void findExactly(const SiteSet& sites, const SiteTree& tree, std::span<const std::uint32_t> which,
                 int threads, CellNeighbors& out) {
  collect(which.size(), threads, out, [&] {
    return [&, finder = std::make_unique<ExactFinder>(sites, tree)](std::size_t e,
                                                                    std::vector<std::int32_t>& neighbors) {
      return finder->find(which[e], neighbors);
    };
  });
}

}  // namespace vorpipe::cpu
