#include "cells/tied_vertices.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "geometry/vertex_predicates.h"

namespace vorpipe::core {
namespace {

constexpr std::uint8_t wall_at_x = 3, wall_at_y = 12, wall_placed = 16;

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
  [[nodiscard]] std::span<const std::int32_t> rowOf(std::size_t k) const {
    return proposed_.cells.edges(tied_.cell[k]);
  }

  [[nodiscard]] AnchoredPoint cornerOf(std::size_t k, std::span<const std::int32_t> row,
                                       std::size_t e) const {
    return cornerPosition(sites_, static_cast<std::int32_t>(tied_.cell[k]), row[edgeBefore(row, e)], row[e]);
  }

  /// Numbers the sets in the order of their roots.
  void number() {
    std::vector<std::uint32_t> roots((tied_.cell.size() + tied_grain - 1) / tied_grain + 1);
    parallelFor(tied_.cell.size(), tied_grain, proposed_.threads, [&](std::size_t begin, std::size_t end) {
      std::uint32_t count = 0;
      for (auto c = tied_.offsets[begin]; c < tied_.offsets[end]; ++c) count += isRoot(c) ? 1u : 0u;
      roots[begin / tied_grain + 1] = count;
    });
    for (std::size_t b = 1; b < roots.size(); ++b) roots[b] += roots[b - 1];
    parallelFor(tied_.cell.size(), tied_grain, proposed_.threads, [&](std::size_t begin, std::size_t end) {
      auto next = roots[begin / tied_grain];
      for (auto c = tied_.offsets[begin]; c < tied_.offsets[end]; ++c) {
        if (isRoot(c)) tied_.vertex[c] = next++;
      }
    });
    forTiedCells(tied_, proposed_.threads, [&](std::size_t k) {
      for (auto c = tied_.offsets[k]; c < tied_.offsets[k + 1]; ++c) {
        const auto root = sets_.root(static_cast<std::uint32_t>(c));
        if (root != c) tied_.vertex[c] = tied_.vertex[root];
      }
    });
    tied_.position.resize(roots.back());
    tied_.walls.assign(roots.back(), 0);
  }

  bool isRoot(std::uint64_t corner) { return sets_.root(static_cast<std::uint32_t>(corner)) == corner; }

  /// Lists the cells at each vertex. Each offset begins at its list's end, and counts down to its beginning.
  void gather() {
    const auto vertices = tied_.position.size();
    auto& first = tied_.around_offsets;
    first.assign(vertices + 1, 0);
    forTiedCells(tied_, proposed_.threads, [&](std::size_t k) {
      for (auto c = tied_.offsets[k]; c < tied_.offsets[k + 1]; ++c) {
        std::atomic_ref(first[tied_.vertex[c]]).fetch_add(1, std::memory_order_relaxed);
      }
    });
    for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
    tied_.around.resize(tied_.vertex.size());
    forTiedCells(tied_, proposed_.threads, [&](std::size_t k) {
      for (auto c = tied_.offsets[k]; c < tied_.offsets[k + 1]; ++c) {
        const auto end = std::atomic_ref(first[tied_.vertex[c]]).fetch_sub(1, std::memory_order_relaxed);
        tied_.around[end - 1] = tied_.cell[k];
      }
    });
  }

  /// Places vertices that have no position yet at their root corners; lists the cells at walls.
  void placeRoots() {
    at_wall_.resize((tied_.cell.size() + tied_grain - 1) / tied_grain);
    forTiedCells(tied_, proposed_.threads, [&](std::size_t k) {
      const auto row = rowOf(k);
      bool wall = false;
      for (std::size_t e = 0; e < row.size(); ++e) {
        const auto c = tied_.offsets[k] + e;
        wall = wall || row[e] < 0;
        if (!isRoot(c)) continue;
        auto& place = tied_.position[tied_.vertex[c]];
        if (std::isnan(place.base.x)) place = cornerOf(k, row, e);
      }
      if (wall) at_wall_[k / tied_grain].push_back(static_cast<std::uint32_t>(k));
    });
  }

  /// Places vertices of three or more tied cells at the center of three sites: that of the lowest input
  /// index, the one farthest from it, and the one farthest from the line through both. If the three are
  /// nearly collinear, the vertex gets no position.
  void placeInside() {
    parallelEach(tied_.position.size(), tied_grain, proposed_.threads, [&](std::size_t v) {
      const auto first = tied_.around.begin();
      std::sort(first + tied_.around_offsets[v], first + tied_.around_offsets[v + 1]);
      placeBetween(tied_.cellsAt(v), tied_.position[v]);
    });
  }

  /// Whether three sites are so nearly collinear that their power center may be far less precise than that of
  /// other sites at the vertex. Only with weights.
  static bool isFlat(Point line, Point to_third) {
    constexpr double share = 1e-3;
    return std::abs(line.x * to_third.y - line.y * to_third.x) <= share * (line.x * line.x + line.y * line.y);
  }

  /// The cell of the lowest input index.
  [[nodiscard]] std::uint32_t lowestOf(std::span<const std::uint32_t> cells) const {
    return *std::ranges::min_element(cells, {}, [&](std::uint32_t cell) { return sites_.id[cell]; });
  }

  void placeBetween(std::span<const std::uint32_t> cells, AnchoredPoint& place) const {
    if (cells.size() == 3 && cells[0] < cells[1] && cells[1] < cells[2] && sites_.weight.empty()) {
      place = cornerPosition(sites_, static_cast<std::int32_t>(cells[0]), static_cast<std::int32_t>(cells[1]),
                             static_cast<std::int32_t>(cells[2]));
      return;
    }
    const auto first = lowestOf(cells);
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
      walls = static_cast<std::uint8_t>(walls | wallBit(row[edgeBefore(row, e)]) | wallBit(row[e]));
    }
  }

  /// Where the bisector of two cells at a vertex crosses a wall. The cells are that of the lowest input index
  /// and the one farthest from it along the wall, whose bisector crosses most steeply. Clamped to the domain,
  /// since near a corner of the domain the crossing may lie outside.
  [[nodiscard]] AnchoredPoint placeOnWall(std::size_t k, std::size_t e, std::int32_t wall) const {
    const auto row = rowOf(k);
    const auto cells = tied_.cellsAt(tied_.vertex[tied_.offsets[k] + e]);
    const auto& along = isVerticalWall(wall) ? sites_.y : sites_.x;
    const auto first = lowestOf(cells);
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
      const auto wall = std::min(row[e], row[edgeBefore(row, e)]);
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

/// Finds the cells that ties enclose: no path across edges leads from such a cell to a wall.
class EnclosedCells {
 public:
  EnclosedCells(const ProposedCells& proposed, DisjointSets& sets, TiedCells& tied)
      : sites_(proposed.sites), cells_(proposed.cells), sets_(sets), tied_(tied) {}

  /// Whether corners were joined.
  bool run() {
    countRings();
    for (std::size_t k = 0; k < tied_.cell.size(); ++k) {
      if (touchesRing(k)) searchFrom(tied_.cell[k]);
    }
    std::sort(tied_.enclosed.begin(), tied_.enclosed.end());
    return joined_;
  }

 private:
  enum class State : std::uint8_t { unknown, enclosed, reaches_wall };

  /// Joining n corners of the diagram without a cycle takes n - 1 ties: a tree. Counts ties - corners + 1 at
  /// each vertex, in sixths. Each of three cells contributes 2 for a corner of the diagram, each of two cells
  /// 3 at a wall, the only cell 6 in a corner of the domain. For a tie between two sites each of their cells
  /// contributes 3. If the count is 0 there is no cycle.
  void countRings() {
    excess_.assign(tied_.position.size(), one_corner);
    for (std::size_t k = 0; k < tied_.cell.size(); ++k) {
      const auto row = cells_.edges(tied_.cell[k]);
      for (std::size_t e = 0; e < row.size(); ++e) {
        const auto corner = tied_.offsets[k] + e;
        const int walls = (row[e] < 0 ? 1 : 0) + (row[edgeBefore(row, e)] < 0 ? 1 : 0);
        excess_[tied_.vertex[corner]] -= walls == 0 ? 2 : (walls == 1 ? 3 : one_corner);
        if (tied_.tie[corner] != 0) excess_[tied_.vertex[corner]] += row[e] < 0 ? one_corner : 3;
      }
    }
  }

  [[nodiscard]] bool touchesRing(std::size_t k) const {
    return std::ranges::any_of(tied_.vertices(k), [&](auto vertex) { return excess_[vertex] != 0; });
  }

  [[nodiscard]] bool isKept(std::uint32_t cell, std::size_t e) const {
    return !tied_.has(cell) || tied_.ties(tied_.entry[cell])[e] == 0;
  }

  void searchFrom(std::uint32_t first) {
    if (state_.empty()) state_.assign(sites_.size(), State::unknown);
    if (state_[first] != State::unknown) return;
    region_.assign(1, first);
    state_[first] = State::enclosed;
    auto what = State::enclosed;
    for (std::size_t next = 0; next < region_.size(); ++next) {
      const auto cell = region_[next];
      const auto row = cells_.edges(cell);
      for (std::size_t e = 0; e < row.size(); ++e) {
        if (!isKept(cell, e)) continue;
        if (row[e] < 0) {
          what = State::reaches_wall;
          continue;
        }
        auto& state = state_[static_cast<std::size_t>(row[e])];
        if (state == State::reaches_wall) what = state;
        if (state != State::unknown) continue;
        state = State::enclosed;
        region_.push_back(static_cast<std::uint32_t>(row[e]));
      }
      if (what == State::reaches_wall) break;
    }
    if (what == State::enclosed) return collapse();
    for (const auto cell : region_) state_[cell] = what;
  }

  /// Makes one vertex of all corners of the cells in region_, one of which is tied.
  void collapse() {
    const auto vertex = static_cast<std::uint32_t>(tied_.offsets[tied_.entry[region_.front()]]);
    for (const auto cell : region_) {
      if (!tied_.has(cell)) {
        tied_.enclosed.push_back(cell);
        continue;
      }
      const auto k = tied_.entry[cell];
      for (auto c = tied_.offsets[k]; c < tied_.offsets[k + 1]; ++c) {
        joined_ = joined_ || sets_.root(static_cast<std::uint32_t>(c)) != sets_.root(vertex);
        sets_.join(static_cast<std::uint32_t>(c), vertex);
        tied_.tie[c] = 1;
      }
    }
  }

  static constexpr int one_corner = 6;

  const SiteSet& sites_;
  const NeighborRows& cells_;
  DisjointSets& sets_;
  TiedCells& tied_;
  std::vector<int> excess_;  ///< by vertex, in sixths: ties beyond a tree
  std::vector<State> state_;
  std::vector<std::uint32_t> region_;
  bool joined_ = false;
};

}  // namespace

void makeVertices(const ProposedCells& proposed, DisjointSets& corners, TiedCells& tied) {
  VertexBuilder(proposed, corners, tied).run();
}

void dropCollapsed(const ProposedCells& proposed, DisjointSets& corners, TiedCells& tied) {
  forTiedCells(tied, proposed.threads, [&](std::size_t k) {
    for (auto c = tied.offsets[k]; c < tied.offsets[k + 1]; ++c) {
      const auto next = c + 1 < tied.offsets[k + 1] ? c + 1 : tied.offsets[k];
      if (tied.vertex[c] == tied.vertex[next]) tied.tie[c] = 1;
    }
  });
  if (proposed.sites.weight.empty()) return;
  if (EnclosedCells(proposed, corners, tied).run() && tied.enclosed.empty()) {
    makeVertices(proposed, corners, tied);
  }
}

}  // namespace vorpipe::core
