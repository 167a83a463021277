#include "cells/tied_vertices.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "geometry/wall_predicates.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t tied_vertices_grain = 1024;
constexpr std::uint8_t wall_at_x = 3, wall_at_y = 12, wall_placed = 16;

std::size_t before(std::span<const std::int32_t> row, std::size_t e) {
  return e > 0 ? e - 1 : row.size() - 1;
}

class VertexBuilder {
 public:
  VertexBuilder(const ProposedCells& proposed, DisjointSets& sets, TiedCells& tied)
      : proposed_(proposed), sites_(proposed.sites), sets_(sets), tied_(tied) {}

  void run() {
    number();
    gather();
    placeInside();
    placeRoots();
    placeAtWalls();
  }

 private:
  template <class Work>
  void forEntries(const Work& work) {
    parallelFor(tied_.cell.size(), tied_vertices_grain, proposed_.threads,
                [&](std::size_t begin, std::size_t end) {
                  for (auto k = begin; k < end; ++k) work(k);
                });
  }

  [[nodiscard]] std::span<const std::int32_t> rowOf(std::size_t k) const {
    return proposed_.cells.edges(tied_.cell[k]);
  }

  [[nodiscard]] AnchoredPoint cornerOf(std::size_t k, std::span<const std::int32_t> row,
                                       std::size_t e) const {
    return cornerPosition(sites_, static_cast<std::int32_t>(tied_.cell[k]), row[before(row, e)], row[e]);
  }

  /// Numbers the sets in the order of their roots.
  void number() {
    std::vector<std::uint32_t> roots((tied_.cell.size() + tied_vertices_grain - 1) / tied_vertices_grain + 1);
    parallelFor(tied_.cell.size(), tied_vertices_grain, proposed_.threads,
                [&](std::size_t begin, std::size_t end) {
                  std::uint32_t count = 0;
                  for (auto c = tied_.offsets[begin]; c < tied_.offsets[end]; ++c)
                    count += isRoot(c) ? 1u : 0u;
                  roots[begin / tied_vertices_grain + 1] = count;
                });
    for (std::size_t b = 1; b < roots.size(); ++b) roots[b] += roots[b - 1];
    parallelFor(tied_.cell.size(), tied_vertices_grain, proposed_.threads,
                [&](std::size_t begin, std::size_t end) {
                  auto next = roots[begin / tied_vertices_grain];
                  for (auto c = tied_.offsets[begin]; c < tied_.offsets[end]; ++c) {
                    if (isRoot(c)) tied_.vertex[c] = next++;
                  }
                });
    forEntries([&](std::size_t k) {
      for (auto c = tied_.offsets[k]; c < tied_.offsets[k + 1]; ++c) {
        const auto root = sets_.root(static_cast<std::uint32_t>(c));
        if (root != c) tied_.vertex[c] = tied_.vertex[root];
      }
    });
    tied_.position.resize(roots.back());
    tied_.walls.assign(roots.back(), 0);
  }

  bool isRoot(std::uint64_t corner) { return sets_.root(static_cast<std::uint32_t>(corner)) == corner; }

  /// Lists the cells at each vertex, ascending.
  void gather() {
    const auto vertices = tied_.position.size();
    auto& first = tied_.around_offsets;
    first.assign(vertices + 1, 0);
    forEntries([&](std::size_t k) {
      for (auto c = tied_.offsets[k]; c < tied_.offsets[k + 1]; ++c) {
        std::atomic_ref(first[tied_.vertex[c] + std::size_t{1}]).fetch_add(1, std::memory_order_relaxed);
      }
    });
    for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
    tied_.around.resize(tied_.vertex.size());
    auto next = first;
    forEntries([&](std::size_t k) {
      for (auto c = tied_.offsets[k]; c < tied_.offsets[k + 1]; ++c) {
        const auto at = std::atomic_ref(next[tied_.vertex[c]]).fetch_add(1, std::memory_order_relaxed);
        tied_.around[at] = tied_.cell[k];
      }
    });
  }

  /// Places vertices that have no position yet at their root corners; lists the cells at walls.
  void placeRoots() {
    at_wall_.resize((tied_.cell.size() + tied_vertices_grain - 1) / tied_vertices_grain);
    forEntries([&](std::size_t k) {
      const auto row = rowOf(k);
      bool wall = false;
      for (std::size_t e = 0; e < row.size(); ++e) {
        const auto c = tied_.offsets[k] + e;
        wall = wall || row[e] < 0;
        if (!isRoot(c)) continue;
        auto& place = tied_.position[tied_.vertex[c]];
        if (std::isnan(place.base.x)) place = cornerOf(k, row, e);
      }
      if (wall) at_wall_[k / tied_vertices_grain].push_back(static_cast<std::uint32_t>(k));
    });
  }

  /// Places vertices of three or more tied cells at the center of three sites: that of the lowest input
  /// index, the one farthest from it, and the one farthest from the line through both. If the three are
  /// nearly collinear, the vertex gets no position.
  void placeInside() {
    parallelFor(tied_.position.size(), tied_vertices_grain, proposed_.threads,
                [&](std::size_t begin, std::size_t end) {
                  for (auto v = begin; v < end; ++v) {
                    const auto cells = std::span(tied_.around)
                                           .subspan(tied_.around_offsets[v],
                                                    tied_.around_offsets[v + 1] - tied_.around_offsets[v]);
                    std::sort(cells.begin(), cells.end());
                    placeBetween(cells, tied_.position[v]);
                  }
                });
  }

  /// Whether three sites are so nearly collinear that their power center may be far less precise than that of
  /// other sites at the vertex. Only with weights.
  static bool isFlat(Point line, Point to_third) {
    constexpr double share = 1e-3;
    return std::abs(line.x * to_third.y - line.y * to_third.x) <= share * (line.x * line.x + line.y * line.y);
  }

  void placeBetween(std::span<const std::uint32_t> cells, AnchoredPoint& place) const {
    if (cells.size() == 3 && cells[0] < cells[1] && cells[1] < cells[2] && sites_.weight.empty()) {
      place = cornerPosition(sites_, static_cast<std::int32_t>(cells[0]), static_cast<std::int32_t>(cells[1]),
                             static_cast<std::int32_t>(cells[2]));
      return;
    }
    const auto first = *std::min_element(cells.begin(), cells.end(),
                                         [&](auto a, auto b) { return sites_.id[a] < sites_.id[b]; });
    const auto wayTo = [&](std::uint32_t cell) {
      return Point{sites_.x[cell] - sites_.x[first], sites_.y[cell] - sites_.y[first]};
    };
    const auto farthest = [&](const auto& measure) {
      auto best = first;
      double most = 0;
      for (const auto cell : cells) {
        const double value = measure(wayTo(cell));
        if (value > most || (value == most && sites_.id[cell] < sites_.id[best])) best = cell;
        most = std::max(most, value);
      }
      return best;
    };
    const auto second = farthest([](Point p) { return p.x * p.x + p.y * p.y; });
    const Point line = wayTo(second);
    const auto third = farthest([line](Point p) { return std::abs(line.x * p.y - line.y * p.x); });
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    place = {{none, none}, {0, 0}};
    if (second == first || third == first || third == second) return;
    if (!sites_.weight.empty() && isFlat(line, wayTo(third))) return;
    place = cornerPosition(sites_, static_cast<std::int32_t>(first), static_cast<std::int32_t>(second),
                           static_cast<std::int32_t>(third));
  }

  void placeAtWalls() {
    for (const auto& some : at_wall_) {
      for (const auto k : some) noteWalls(k);
    }
    for (const auto& some : at_wall_) {
      for (const auto k : some) placeAtWalls(k);
    }
  }

  void noteWalls(std::size_t k) {
    const auto row = rowOf(k);
    for (std::size_t e = 0; e < row.size(); ++e) {
      auto& walls = tied_.walls[tied_.vertex[tied_.offsets[k] + e]];
      walls = static_cast<std::uint8_t>(walls | wallBit(row[before(row, e)]) | wallBit(row[e]));
    }
  }

  /// Where the bisector of two cells at a vertex crosses a wall. The cells are that of the lowest input index
  /// and the one farthest from it along the wall, whose bisector crosses most steeply. Clamped to the domain,
  /// since near a corner of the domain the crossing may lie outside.
  [[nodiscard]] AnchoredPoint placeOnWall(std::size_t k, std::size_t e, std::int32_t wall) const {
    const auto row = rowOf(k);
    const auto vertex = tied_.vertex[tied_.offsets[k] + e];
    const auto cells = std::span(tied_.around)
                           .subspan(tied_.around_offsets[vertex],
                                    tied_.around_offsets[vertex + 1] - tied_.around_offsets[vertex]);
    const auto& along = isVerticalWall(wall) ? sites_.y : sites_.x;
    const auto first = *std::min_element(cells.begin(), cells.end(),
                                         [&](auto a, auto b) { return sites_.id[a] < sites_.id[b]; });
    const auto away = [&](auto cell) { return std::abs(along[cell] - along[first]); };
    const auto second = *std::max_element(cells.begin(), cells.end(), [&](auto a, auto b) {
      return away(a) != away(b) ? away(a) < away(b) : sites_.id[a] > sites_.id[b];
    });
    const auto place = away(second) > 0 ? cornerPosition(sites_, static_cast<std::int32_t>(first), wall,
                                                         static_cast<std::int32_t>(second))
                                        : cornerOf(k, row, e);
    return inDomain(place);
  }

  /// The nearest point of the domain.
  [[nodiscard]] AnchoredPoint inDomain(AnchoredPoint place) const {
    const auto clamp = [](double low, double high, double& base, double& rest) {
      const bool below = (base - low) + rest < 0, above = (high - base) - rest < 0;
      if (!below && !above) return;
      base = below ? low : high;
      rest = 0;
    };
    const Box& d = sites_.domain;
    clamp(d.xmin, d.xmax, place.base.x, place.rest.x);
    clamp(d.ymin, d.ymax, place.base.y, place.rest.y);
    return place;
  }

  void placeAtWalls(std::size_t k) {
    const auto row = rowOf(k);
    for (std::size_t e = 0; e < row.size(); ++e) {
      const auto vertex = tied_.vertex[tied_.offsets[k] + e];
      auto& walls = tied_.walls[vertex];
      const auto wall = std::min(row[e], row[before(row, e)]);
      if (wall >= 0 || (walls & wall_placed) != 0) continue;
      const Box& domain = sites_.domain;
      if ((walls & wall_at_x) != 0 && (walls & wall_at_y) != 0) {
        tied_.position[vertex] = {{wallCoordinate(domain, (walls & 1) != 0 ? wall_xmin : wall_xmax),
                                   wallCoordinate(domain, (walls & 4) != 0 ? wall_ymin : wall_ymax)},
                                  {0, 0}};
      } else {
        tied_.position[vertex] = placeOnWall(k, e, wall);
      }
      walls |= wall_placed;
    }
  }

  const ProposedCells& proposed_;
  const SiteSet& sites_;
  DisjointSets& sets_;
  TiedCells& tied_;
  std::vector<std::vector<std::uint32_t>> at_wall_;  ///< tied cells with walls, in parts
};

}  // namespace

void makeVertices(const ProposedCells& proposed, DisjointSets& corners, TiedCells& tied) {
  VertexBuilder(proposed, corners, tied).run();
}

}  // namespace vorpipe::core
