#include "cells/flann_search.h"

#include <flann/flann.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t flann_search_grain = 2048;
/// FLANN compares rounded squared distances; relative to its distance, a neighbor may come this much too
/// late.
constexpr double rounding_slack = 1e-14;

/// Interleaves coordinates, as FLANN expects them.
std::vector<double> interleave(const SiteSet& sites) {
  std::vector<double> points(2 * sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    points[2 * i] = sites.x[i];
    points[2 * i + 1] = sites.y[i];
  }
  return points;
}

}  // namespace

struct FlannSearch::Tree {
  using Index = flann::KDTreeSingleIndex<flann::L2_Simple<double>>;

  Tree(const SiteSet& set, int thread_count)
      : sites(set),
        threads(thread_count),
        points(interleave(set)),
        index(flann::Matrix<double>(points.data(), set.size(), 2), flann::KDTreeSingleIndexParams(10, true)) {
    index.buildIndex();
  }

  void find(const double* queries, std::size_t count, std::size_t k, std::size_t* found,
            double* squared) const {
    flann::SearchParams exact(flann::FLANN_CHECKS_UNLIMITED, 0.0f, true);
    exact.cores = 1;
    exact.use_heap = flann::FLANN_False;
    const flann::Matrix<double> rows(const_cast<double*>(queries), count, 2);
    flann::Matrix<std::size_t> indices(found, count, k);
    flann::Matrix<double> distances(squared, count, k);
    index.knnSearch(rows, indices, distances, k, exact);
  }

  const SiteSet& sites;
  int threads;
  std::vector<double> points;
  Index index;
};

FlannSearch::FlannSearch(const SiteSet& sites, int threads) : tree_(std::make_unique<Tree>(sites, threads)) {}
FlannSearch::~FlannSearch() = default;

Candidates FlannSearch::neighbors(std::span<const std::uint32_t> which, std::size_t k) const {
  const auto& sites = tree_->sites;
  const bool all = k + 1 >= sites.size();
  k = all ? sites.size() - 1 : k;
  Candidates candidates;
  candidates.site.assign(which.begin(), which.end());
  candidates.offsets.resize(which.size() + 1);
  for (std::size_t e = 0; e <= which.size(); ++e) candidates.offsets[e] = static_cast<std::uint32_t>(e * k);
  candidates.index.resize(which.size() * k);
  candidates.reach.assign(which.size(), std::numeric_limits<double>::infinity());
  if (k == 0) return candidates;

  parallelFor(which.size(), flann_search_grain, tree_->threads, [&](std::size_t begin, std::size_t end) {
    const auto count = end - begin;
    std::vector<double> queries(2 * count);
    for (std::size_t e = 0; e < count; ++e) {
      queries[2 * e] = sites.x[which[begin + e]];
      queries[2 * e + 1] = sites.y[which[begin + e]];
    }
    std::vector<std::size_t> found(count * (k + 1));
    std::vector<double> squared(count * (k + 1));
    tree_->find(queries.data(), count, k + 1, found.data(), squared.data());
    for (std::size_t e = 0; e < count; ++e) {
      const auto* row = &found[e * (k + 1)];
      auto* out = &candidates.index[(begin + e) * k];
      // The site itself comes first, unless others are so near that squared distances round to 0.
      const auto self = std::find(row, row + k, which[begin + e]);
      out = std::transform(row, self, out, [](std::size_t i) { return static_cast<std::uint32_t>(i); });
      std::transform(self + 1, row + k + 1, out, [](std::size_t i) { return static_cast<std::uint32_t>(i); });
      if (!all) candidates.reach[begin + e] = std::sqrt(squared[e * (k + 1) + k]) * (1 - rounding_slack);
    }
  });
  return candidates;
}

}  // namespace vorpipe::core
