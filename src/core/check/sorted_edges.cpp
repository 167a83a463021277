#include "core/check/sorted_edges.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "core/check/places.h"

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

std::span<const std::uint32_t> SortedEdges::edgesOf(std::size_t i, std::size_t j) const {
  const auto all = std::span(edges_).subspan(run_.begin(i), run_.edges(i));
  const auto those = std::ranges::equal_range(all, static_cast<std::int64_t>(j), {},
                                              [&](std::uint32_t k) { return neighbor(i, k); });
  return {those.begin(), those.end()};
}

bool SortedEdges::has(std::size_t i, std::size_t j) const { return !edgesOf(i, j).empty(); }

bool SortedEdges::has(std::size_t i, std::size_t j, Point a, Point b) const {
  const auto from_a = std::ranges::equal_range(edgesOf(i, j), PlaceKey(a), {},
                                               [&](std::uint32_t k) { return PlaceKey(from(i, k)); });
  return std::ranges::any_of(from_a, [&](std::uint32_t k) { return to(i, k) == b; });
}

Point SortedEdges::to(std::size_t i, std::uint32_t k) const {
  const auto& starts = run_.diagram.ring_starts;
  const std::uint64_t edge = run_.begin(i) + k;
  const auto next_ring = std::ranges::upper_bound(starts, edge);
  const std::uint64_t end = next_ring != starts.end() ? *next_ring : run_.diagram.neighbors.size();
  return run_.vertex(edge + 1 < end ? edge + 1 : *std::prev(next_ring));
}

}  // namespace vorpipe::core::checks
