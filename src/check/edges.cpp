#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "check/checks.h"

namespace vorpipe::core::checks {
namespace {

constexpr std::size_t edges_grain = 4096;

/// A vertex in one cell, where its edge `edge` begins.
struct Corner {
  std::size_t cell, edge;
};

/// The corners around a vertex: each is followed, clockwise, by that of the cell across its edge.
struct Rotation {
  const CheckedCells& run;
  const Twins& twins;

  [[nodiscard]] std::optional<Corner> after(Corner c) const {
    if (run.diagram.neighbors[c.edge] < 0) return {};
    const auto cell = static_cast<std::size_t>(run.diagram.neighbors[c.edge]);
    return Corner{cell, run.next(cell, run.begin(cell) + twins[c.edge])};
  }
  [[nodiscard]] std::optional<Corner> before(Corner c) const {
    const std::size_t edge = run.previous(c.cell, c.edge);
    if (run.diagram.neighbors[edge] < 0) return {};
    const auto cell = static_cast<std::size_t>(run.diagram.neighbors[edge]);
    return Corner{cell, run.begin(cell) + twins[edge]};
  }
};

/// Walks around a vertex from one of its corners, alternating between both directions.
class VertexWalk {
 public:
  VertexWalk(const Rotation& rotation, Corner corner)
      : rotation_(rotation), start_(corner), ahead_(corner), behind_(corner) {}

  /// Whether no corner of the vertex comes earlier in the arrays. Walking in both directions finds an earlier
  /// one quickly on average, for any number and order of cells.
  bool isFirst() {
    while (!(wall_ahead_ && wall_behind_) && !closed_) {
      if (!wall_ahead_) step(rotation_.after(ahead_), ahead_, behind_, wall_ahead_);
      if (!wall_behind_ && !closed_ && !earlier_)
        step(rotation_.before(behind_), behind_, ahead_, wall_behind_);
      if (earlier_) return false;
    }
    return true;
  }

 private:
  void step(const std::optional<Corner>& next, Corner& here, const Corner& other, bool& wall) {
    wall = !next;
    if (!next) return;
    closed_ = next->edge == other.edge;
    earlier_ = next->edge < start_.edge;
    here = *next;
  }

  const Rotation& rotation_;
  Corner start_, ahead_, behind_;
  bool wall_ahead_ = false, wall_behind_ = false, closed_ = false, earlier_ = false;
};

struct Counts {
  std::size_t vertices = 0, edges = 0, faces = 0;
};

Counts countCell(const Rotation& rotation, std::size_t i) {
  const CheckedCells& run = rotation.run;
  Counts counts;
  counts.faces = run.edges(i) > 0 ? 1 : 0;
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    const std::int64_t neighbor = run.diagram.neighbors[e];
    // The first of two cells counts their edge; between two images of a cell, one counts it.
    const auto own = static_cast<std::int64_t>(i);
    const bool self = neighbor == own && run.shift(e) > Shift{0, 0};
    counts.edges += neighbor < 0 || neighbor > own || self ? 1 : 0;
    if (VertexWalk(rotation, {i, e}).isFirst()) ++counts.vertices;
  }
  return counts;
}

Counts countAll(const Rotation& rotation) {
  const CheckedCells& run = rotation.run;
  std::vector<Counts> parts((run.size() + edges_grain - 1) / edges_grain);
  parallelFor(run.size(), edges_grain, run.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Counts cell = countCell(rotation, i);
      Counts& part = parts[begin / edges_grain];
      part = {part.vertices + cell.vertices, part.edges + cell.edges, part.faces + cell.faces};
    }
  });
  Counts all;
  for (const Counts& part : parts) {
    all = {all.vertices + part.vertices, all.edges + part.edges, all.faces + part.faces};
  }
  return all;
}

/// The possible distance between copies of a vertex of cell i, after a shift by a period. If ties may be
/// longer than a period, a vertex may stand for all of its copies.
double copySlack(const CheckedCells& run, std::size_t i, std::size_t vertex) {
  constexpr double part = 1e-12;  // of its distance from the site
  if (!run.repeats()) return 0;
  const double slack = run.rounding(i) + part * length(run.vertex(vertex) - run.site(i));
  const double ties = run.mayBeNarrow() ? run.ties(run.reach(i)) : 0;
  return ties < run.shortestPeriod() ? slack : slack + ties;
}

/// Whether a vertex of cell i equals a vertex of the cell across its edge e.
bool isSamePlace(const CheckedCells& run, std::size_t i, std::size_t vertex, std::size_t other,
                 std::size_t e) {
  if (!run.repeats()) return run.diagram.vertices[vertex] == run.diagram.vertices[other];
  return length(run.vertex(vertex) - run.moved(run.vertex(other), run.shift(e))) <= copySlack(run, i, vertex);
}

std::string wrongTwin(const CheckedCells& run, const Twins& twins, std::size_t i) {
  const Diagram& d = run.diagram;
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    if (d.neighbors[e] < 0) continue;
    const auto j = static_cast<std::size_t>(d.neighbors[e]);
    if (twins[e] == no_twin) return fmt::format("sites {} and {} do not name each other once each", i, j);
    if (run.detail == Detail::measures) continue;
    const std::size_t back = run.begin(j) + twins[e];
    if (!isSamePlace(run, i, e, run.next(j, back), e) || !isSamePlace(run, i, run.next(i, e), back, e)) {
      return fmt::format("the edge of sites {} and {} ends elsewhere in each cell", i, j);
    }
    if (!(std::abs(d.edge_lengths[e] - d.edge_lengths[back]) * run.scale <= 2 * copySlack(run, i, e))) {
      return fmt::format("the edge of sites {} and {} is {} long in one cell and {} in the other", i, j,
                         d.edge_lengths[e], d.edge_lengths[back]);
    }
  }
  return {};
}

/// Whether ties extend across a domain that repeats, beside cell i: two consecutive edges are opposite walls,
/// or its own opposite images.
bool isPinched(const CheckedCells& run, std::size_t i) {
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    const std::int64_t a = run.diagram.neighbors[e], b = run.diagram.neighbors[run.next(i, e)];
    if (a < 0 && b < 0) {
      if (a != b && std::max(a, b) - std::min(a, b) == 1 && std::max(a, b) % 2 != 0) return true;
    } else if (a == b && a == static_cast<std::int64_t>(i)) {
      const auto s = run.shift(e), t = run.shift(run.next(i, e));
      if (s[0] == -t[0] && s[1] == -t[1]) return true;
    }
  }
  return false;
}

/// The number of connected components of the cells with edges. Components are joined in points, at walls,
/// where only ties lie between them.
std::size_t countParts(const CheckedCells& run) {
  std::vector<std::size_t> above(run.size());
  std::iota(above.begin(), above.end(), std::size_t{0});
  const auto top = [&above](std::size_t i) {
    while (above[i] != i) i = above[i] = above[above[i]];
    return i;
  };
  std::size_t parts = 0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (run.edges(i) > 0) ++parts;
    for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
      if (run.diagram.neighbors[e] < 0) continue;
      const std::size_t a = top(i), b = top(static_cast<std::size_t>(run.diagram.neighbors[e]));
      if (a == b) continue;
      above[std::max(a, b)] = std::min(a, b);
      --parts;
    }
  }
  return parts;
}

}  // namespace

Twins findTwins(const CheckedCells& run) {
  const Diagram& d = run.diagram;
  Twins twins(d.neighbors.size(), no_twin);
  // In each pair the cell with more edges searches the list of the other, so a cell with 100,000 neighbors is
  // not searched by each of them. Each entry is thus written for one pair only.
  parallelFor(run.size(), edges_grain, run.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
        const auto j = static_cast<std::size_t>(d.neighbors[e]);
        if (d.neighbors[e] < 0 || std::pair(run.edges(j), j) > std::pair(run.edges(i), i)) continue;
        const Shift opposite{-run.shift(e)[0], -run.shift(e)[1]};
        std::size_t back = run.begin(j), found = 0;
        for (std::size_t k = run.begin(j); k < run.end(j); ++k) {
          if (d.neighbors[k] != static_cast<std::int64_t>(i) || run.shift(k) != opposite) continue;
          back = k;
          ++found;
        }
        if (found != 1 || twins[back] != no_twin) continue;
        twins[e] = static_cast<std::uint32_t>(back - run.begin(j));
        twins[back] = static_cast<std::uint32_t>(e - run.begin(i));
      }
    }
  });
  return twins;
}

bool checkSymmetry(const CheckedCells& run, const Twins& twins, Broken& broken) {
  return broken.expectEach("symmetry", run, [&](std::size_t i) { return wrongTwin(run, twins, i); });
}

void checkPartition(const CheckedCells& run, const Twins& twins, Broken& broken) {
  for (std::size_t i = 0; run.repeats() && i < run.size(); ++i) {
    if (isPinched(run, i)) return;
  }
  const Counts counts = countAll({run, twins});
  // A band and a torus have no outside face, and have a hole. Any other component is a disk.
  const std::size_t outside = run.repeats() ? 0 : 1;
  const std::size_t parts = countParts(run), rings = run.repeats() ? std::min<std::size_t>(parts, 1) : 0;
  const std::size_t disks = parts - rings;
  if (counts.vertices + counts.faces != counts.edges + disks) {
    broken.add("Euler",
               fmt::format("{} vertices, {} edges and {} faces{} are no partition", counts.vertices,
                           counts.edges, counts.faces + outside, outside > 0 ? " with the outside" : ""));
  }
}

}  // namespace vorpipe::core::checks
