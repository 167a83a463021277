#include "picture/distinct_colors.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <span>

namespace vorpipe::core {
namespace {

/// The sites that each has a common edge with, once each and without itself.
struct Adjacency {
  std::vector<std::uint64_t> offsets{0};
  std::vector<std::uint32_t> neighbors;

  explicit Adjacency(const Diagram& cells) {
    for (std::size_t i = 0; i < cells.status.size(); ++i) {
      for (auto k = cells.cell_offsets[i]; k < cells.cell_offsets[i + 1]; ++k) {
        const std::int64_t neighbor = cells.neighbors[k];
        if (neighbor < 0 || neighbor == static_cast<std::int64_t>(i)) continue;
        neighbors.push_back(static_cast<std::uint32_t>(neighbor));
      }
      const auto begin = neighbors.begin() + static_cast<std::ptrdiff_t>(offsets.back());
      std::sort(begin, neighbors.end());
      neighbors.erase(std::unique(begin, neighbors.end()), neighbors.end());
      offsets.push_back(neighbors.size());
    }
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t site) const {
    return std::span(neighbors).subspan(offsets[site], offsets[site + 1] - offsets[site]);
  }
};

/// Returns the sites in an order in which each has few neighbors before it: the reverse of taking away, again
/// and again, a cell with the fewest that are left (Matula and Beck 1983). Of neighboring cells in a plane,
/// one has at most five.
std::vector<std::uint32_t> smallestLast(const Adjacency& adjacency, std::size_t sites) {
  std::vector<std::vector<std::uint32_t>> with_degree;
  std::vector<std::size_t> degree(sites);
  const auto put = [&](std::uint32_t site) {
    if (degree[site] >= with_degree.size()) with_degree.resize(degree[site] + 1);
    with_degree[degree[site]].push_back(site);
  };
  for (std::uint32_t i = 0; i < sites; ++i) {
    degree[i] = adjacency.of(i).size();
    put(i);
  }
  std::vector<std::uint32_t> order;
  std::vector<bool> taken(sites);
  // A list may hold a site that has fewer neighbors by now: then it stands in another list as well.
  for (std::size_t least = 0; least < with_degree.size();) {
    if (with_degree[least].empty()) {
      ++least;
      continue;
    }
    const std::uint32_t site = with_degree[least].back();
    with_degree[least].pop_back();
    if (taken[site] || degree[site] != least) continue;
    taken[site] = true;
    order.push_back(site);
    for (const std::uint32_t other : adjacency.of(site)) {
      if (taken[other]) continue;
      --degree[other];
      put(other);
      least = std::min(least, degree[other]);
    }
  }
  std::ranges::reverse(order);
  return order;
}

}  // namespace

Result<std::vector<std::uint8_t>> distinctColors(const Diagram& cells, std::size_t most) {
  constexpr std::uint8_t none = 0xFF;
  const Adjacency adjacency(cells);
  std::vector<std::uint8_t> color(cells.status.size(), none);
  std::size_t used = 0;
  for (const std::uint32_t site : smallestLast(adjacency, color.size())) {
    std::uint64_t of_neighbors = 0;
    for (const std::uint32_t other : adjacency.of(site)) {
      if (color[other] != none) of_neighbors |= std::uint64_t{1} << color[other];
    }
    color[site] = static_cast<std::uint8_t>(std::countr_one(of_neighbors));
    used = std::max<std::size_t>(used, color[site] + std::size_t{1});
  }
  if (used > most) {
    return tl::unexpected(Error{
        ErrorCode::input, fmt::format("distinct colors: these cells take {}, and there are {}", used, most)});
  }
  return color;
}

}  // namespace vorpipe::core
