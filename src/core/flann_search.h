/// The k nearest neighbors by FLANN's exact kd-tree, as in the thesis (2.2.1).
#pragma once

#include <memory>

#include "backend/backend.h"
#include "core/candidates.h"

namespace vorpipe {

class FlannSearch {
 public:
  FlannSearch(const SiteSet& sites, int threads);  ///< `sites` must outlive this
  ~FlannSearch();

  /// The k nearest neighbors of each of `which` (indices in the set). Where k covers all sites,
  /// reach is infinite.
  [[nodiscard]] Candidates neighbors(std::span<const std::uint32_t> which, std::size_t k) const;

  /// A site nearest to each point; x, y in scaled units.
  void nearest(std::span<const double> x, std::span<const double> y, std::span<std::uint32_t> out) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace vorpipe
