#include "backend/cpu/exact_tier.h"

#include <cassert>
#include <optional>

#include "backend/cpu/exact_cells.h"
#include "backend/cpu/near_cells.h"
#include "backend/cpu/picture.h"
#include "backend/cpu/tree_cells.h"

namespace vorpipe {
namespace {

/// From one cell in this many sites on, a tree over all sites costs less than it saves.
constexpr std::size_t sites_per_few = 256;

class CpuExactTier final : public ExactTier {
 public:
  explicit CpuExactTier(int threads) : threads_(threads) {}

  void take(const SiteSet& sites) override {
    sites_ = &sites;
    nearest_.reset();
    tree_.reset();
  }

  void cells(std::span<const std::uint32_t> which, Precision precision, CellNeighbors& out) override {
    assert(sites_ != nullptr);
    const cpu::FindOverTree find = precision == Precision::exact ? cpu::findExactly : cpu::findInDouble;
    if (tree_ || which.size() >= sites_->size() / sites_per_few)
      return find(*sites_, tree(), which, threads_, out);
    cpu::findNearby(*sites_, which, find, threads_, out);
    std::vector<std::uint32_t> left;
    for (std::size_t e = 0; e < which.size(); ++e) {
      if (out.status[e] == CellStatus::unsecured) left.push_back(which[e]);
    }
    if (left.empty()) return;
    CellNeighbors anew;
    find(*sites_, tree(), left, threads_, anew);
    cpu::replaceUnsecured(anew, out);
  }

  void nearest(const View& view, std::span<const std::uint32_t> pixels,
               std::span<std::uint32_t> sites) override {
    assert(sites_ != nullptr && sites.size() == pixels.size());
    if (!nearest_) nearest_.emplace(*sites_, threads_);
    cpu::nearestSites(*nearest_, view, pixels, threads_, sites);
  }

 private:
  const cpu::SiteTree& tree() {
    if (!tree_) tree_.emplace(*sites_, threads_);
    return *tree_;
  }

  int threads_;
  const SiteSet* sites_ = nullptr;
  std::optional<cpu::NearestSite> nearest_;  ///< made when first asked
  std::optional<cpu::SiteTree> tree_;        ///< made when first asked
};

class CpuPlaceSearch final : public PlaceSearch {
 public:
  CpuPlaceSearch(const SiteSet& sites, int threads) : nearest_(sites, threads) {}

  [[nodiscard]] std::uint32_t nearest(Point place) const override { return nearest_.at({0, 0}, place); }

 private:
  cpu::NearestSite nearest_;
};

}  // namespace

std::unique_ptr<ExactTier> makeExactTier(int threads) { return std::make_unique<CpuExactTier>(threads); }

std::unique_ptr<PlaceSearch> makePlaceSearch(const SiteSet& sites, int threads) {
  return std::make_unique<CpuPlaceSearch>(sites, threads);
}

}  // namespace vorpipe
