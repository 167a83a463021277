/// The k nearest neighbors by FLANN's exact kd-tree, as in the thesis (2.2.1).
#pragma once

#include <memory>

#include "backend/site_set.h"
#include "cells/bisectors.h"

namespace vorpipe::core {

class FlannSearch {
 public:
  /// Beyond this many, other ways to find a cell are cheaper.
  static constexpr int fewest_neighbors = 3, most_neighbors = 1024;
  /// With fewer neighbors, few cells are certified, however even the sites are.
  static constexpr int usual_neighbors = 30;

  FlannSearch(const SiteSet& sites, int threads);  ///< `sites` must outlive this
  ~FlannSearch();

  /// The k nearest neighbors of each of `which` (indices in the set). If k covers all sites, reach is
  /// infinite.
  [[nodiscard]] Candidates neighbors(std::span<const std::uint32_t> which, std::size_t k) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace vorpipe::core
