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
  std::iota(edges_.begin(), edges_.end(), std::uint64_t{0});
  const bool placed = run.detail != Detail::measures;
  parallelFor(run.size(), grain, run.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto edges = std::span(edges_).subspan(run.begin(i), run.edges(i));
      if (placed) {
        std::ranges::sort(edges, {},
                          [&](std::uint64_t e) { return std::pair(neighborOf(e), PlaceKey(run.vertex(e))); });
      } else {
        std::ranges::sort(edges, {}, [&](std::uint64_t e) { return neighborOf(e); });
      }
    }
  });
}

std::span<const std::uint64_t> SortedEdges::edgesOf(std::size_t i, std::size_t j) const {
  const auto all = std::span(edges_).subspan(run_.begin(i), run_.edges(i));
  const auto those = std::ranges::equal_range(all, static_cast<std::int64_t>(j), {},
                                              [&](std::uint64_t e) { return neighborOf(e); });
  return {those.begin(), those.end()};
}

bool SortedEdges::has(std::size_t i, std::size_t j) const { return !edgesOf(i, j).empty(); }

bool SortedEdges::has(std::size_t i, std::size_t j, Point a, Point b) const {
  const auto from_a = std::ranges::equal_range(edgesOf(i, j), PlaceKey(a), {},
                                               [&](std::uint64_t e) { return PlaceKey(run_.vertex(e)); });
  return std::ranges::any_of(from_a, [&](std::uint64_t e) { return endOf(e) == b; });
}

Point SortedEdges::endOf(std::uint64_t edge) const {
  const auto& starts = run_.diagram.ring_starts;
  const auto next_ring = std::ranges::upper_bound(starts, edge);
  const std::uint64_t end = next_ring != starts.end() ? *next_ring : run_.diagram.neighbors.size();
  return run_.vertex(edge + 1 < end ? edge + 1 : *std::prev(next_ring));
}

}  // namespace vorpipe::core::checks
