#include "backend/cpu/long_cells.h"

#include <optional>

#include "backend/cpu/long_real.h"
#include "backend/cpu/tree_cells.h"

namespace vorpipe::cpu {

/// The second is made once the first leaves a cell open.
struct LongFinder::Finders {
  const SiteSet& sites;
  const SiteTree& tree;
  CellFinder<LongReal<320>> usual{sites, tree};
  std::optional<CellFinder<LongReal<1280>>> longest{};
};

LongFinder::LongFinder(const SiteSet& sites, const SiteTree& tree) : finders_(new Finders{sites, tree}) {}

LongFinder::~LongFinder() = default;

CellStatus LongFinder::find(std::uint32_t site, std::vector<std::int32_t>& neighbors) {
  const auto status = finders_->usual.find(site, neighbors, false);
  if (status != CellStatus::open) return status;
  if (!finders_->longest) finders_->longest.emplace(finders_->sites, finders_->tree);
  return finders_->longest->find(site, neighbors, true);
}

}  // namespace vorpipe::cpu
