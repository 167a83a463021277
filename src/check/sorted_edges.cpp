#include "check/sorted_edges.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "check/places.h"

namespace vorpipe::core::checks {

SortedEdges::SortedEdges(const CheckedCells& run) : run_(run), edges_(run.diagram.neighbors.size()) {
  constexpr std::size_t grain = 4096;
  const bool placed = run.detail != Detail::measures;
  parallelFor(run.size(), grain, run.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto edges = std::span(edges_).subspan(run.begin(i), run.edges(i));
      std::iota(edges.begin(), edges.end(), 0U);
      if (placed) {
        std::ranges::sort(edges, {},
                          [&](std::uint32_t k) { return std::pair(neighbor(i, k), PlaceKey(from(i, k))); });
      } else {
        std::ranges::sort(edges, {}, [&](std::uint32_t k) { return neighbor(i, k); });
      }
    }
  });
}

bool SortedEdges::has(std::size_t i, std::size_t j) const {
  const auto site = static_cast<std::int64_t>(j);
  const auto neighbor_of = [&](std::uint32_t k) { return neighbor(i, k); };
  const auto edges = edgesOf(i);
  const auto first = std::ranges::lower_bound(edges, site, {}, neighbor_of);
  return first != edges.end() && neighbor_of(*first) == site;
}

bool SortedEdges::has(std::size_t i, std::size_t j, Point a, Point b) const {
  const std::pair wanted(static_cast<std::int64_t>(j), PlaceKey(a));
  const auto place_of = [&](std::uint32_t k) { return std::pair(neighbor(i, k), PlaceKey(from(i, k))); };
  const auto edges = edgesOf(i);
  for (auto k = std::ranges::lower_bound(edges, wanted, {}, place_of);
       k != edges.end() && place_of(*k) == wanted; ++k) {
    if (to(i, *k) == b) return true;
  }
  return false;
}

Point SortedEdges::to(std::size_t i, std::uint32_t k) const {
  const auto& starts = run_.diagram.ring_starts;
  const std::uint64_t edge = run_.begin(i) + k;
  const auto next_ring = std::ranges::upper_bound(starts, edge);
  const std::uint64_t end = next_ring != starts.end() ? *next_ring : run_.diagram.neighbors.size();
  return run_.vertex(edge + 1 < end ? edge + 1 : *std::prev(next_ring));
}

}  // namespace vorpipe::core::checks
