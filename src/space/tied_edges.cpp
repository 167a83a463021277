#include "space/tied_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "space/glue.h"
#include "space/place.h"
#include "space/ring_walk.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t edges_at_once = 1024;
/// Each step divides the length of ties by 64; after the last they are as short as rounding errors.
constexpr std::uint8_t finest = 5;
constexpr double step_of_fineness = 1.0 / 64;

Row rowOf(const Rows& rows, Label site) { return rows[static_cast<std::size_t>(site)]; }

}  // namespace

TiedEdges::TiedEdges(const Places& places, const Rows& rows, const SharedVertices& vertices,
                     std::vector<ShortEdge> edges, int threads)
    : places_(places),
      rows_(rows),
      vertices_(vertices),
      edges_(std::move(edges)),
      ends_(edges_.size()),
      threads_(threads) {
  parallelEach(edges_.size(), edges_at_once, threads_, [&](std::size_t e) {
    const std::size_t cell = vertices_.cellOf(edges_[e].site);
    ends_[e] = {vertices_.at(cell, edges_[e].end_before), vertices_.at(cell, edges_[e].edge_end)};
  });
}

double TiedEdges::finenessAt(std::size_t edge) const {
  if (finer_.empty()) return 1;
  constexpr double step = step_of_fineness;
  constexpr double after[finest + 1] = {
      1, step, step * step, step * step * step, step * step * step * step, step * step * step * step * step};
  return after[std::max(finer_[ends_[edge].from], finer_[ends_[edge].to])];
}

struct TiedEdges::Candidates {
  std::vector<std::uint32_t> edges;  ///< ascending
  std::vector<std::uint32_t> begin;  ///< by cell: where those of its site are
  std::vector<EdgeLabels> labels;    ///< by candidate

  static constexpr std::uint32_t none = 0xffffffff;
  /// The candidate between faces of a cell, or none.
  [[nodiscard]] std::uint32_t find(const SharedVertices& vertices, const EdgeLabels& edge) const {
    for (const Label label : edge) {
      if (isWallLabel(label)) continue;
      const std::uint32_t cell = vertices.cellOf(label);
      if (cell == SharedVertices::nowhere) continue;
      for (std::uint32_t c = begin[cell]; c < begin[cell + 1]; ++c) {
        if (labels[c] == edge) return c;
      }
    }
    return none;
  }
};

/// Joins the ends of edges without length; returns those that are longer, but not longer than a tie.
std::vector<std::uint32_t> TiedEdges::joinShortest(DisjointSets& sets) const {
  const std::size_t blocks = (edges_.size() + edges_at_once - 1) / edges_at_once;
  std::vector<std::vector<std::uint32_t>> longer(blocks);
  parallelFor(edges_.size(), edges_at_once, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const double fineness = finenessAt(e);
      if (edges_[e].part <= no_length * fineness) {
        sets.join(ends_[e].from, ends_[e].to);
      } else if (edges_[e].part <= fineness) {
        longer[e / edges_at_once].push_back(static_cast<std::uint32_t>(e));
      }
    }
  });
  std::vector<std::uint32_t> all;
  for (const auto& part : longer) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::uint64_t TiedEdges::join(DisjointSets& sets) {
  Candidates candidates;
  candidates.edges = joinShortest(sets);
  std::uint64_t ties = 0;
  for (std::size_t e = 0; e < edges_.size(); ++e) ties += edges_[e].part <= no_length * finenessAt(e);
  if (candidates.edges.empty()) return ties;

  candidates.begin.assign(vertices_.cells().size() + 1, 0);
  for (const auto e : candidates.edges) ++candidates.begin[vertices_.cellOf(edges_[e].site) + 1];
  for (std::size_t c = 0; c + 1 < candidates.begin.size(); ++c)
    candidates.begin[c + 1] += candidates.begin[c];
  candidates.labels.resize(candidates.edges.size());
  parallelEach(candidates.edges.size(), edges_at_once, threads_, [&](std::size_t c) {
    const ShortEdge& edge = edges_[candidates.edges[c]];
    candidates.labels[c] = labelsAround(rowOf(rows_, edge.site), edge.site, edge.edge_end);
  });
  EdgeClasses classes(candidates.edges.size());
  for (const auto& [candidate, other] : findOnes(sets, candidates)) {
    if (other == Candidates::none) {
      classes.open(candidate);
    } else {
      classes.join(candidate, other);
    }
  }
  // The sites around edges that are one lie on a circle, where the two nearest stand side by side, around one
  // of the edges: a class is not longer than their tie if each of its edges is not longer than its own.
  for (std::uint32_t c = 0; c < candidates.edges.size(); ++c) {
    if (!classes.isWhole(c)) continue;
    sets.join(ends_[candidates.edges[c]].from, ends_[candidates.edges[c]].to);
    ++ties;
  }
  return ties;
}

/// Finds those candidates that are one with another edge, at a face beside them.
std::vector<TiedEdges::Pair> TiedEdges::findOnes(DisjointSets& sets, const Candidates& candidates) const {
  constexpr std::size_t cells_at_once = 256;
  const std::size_t cells = vertices_.cells().size();
  std::vector<std::vector<Pair>> pairs((cells + cells_at_once - 1) / cells_at_once);
  parallelFor(cells, cells_at_once, threads_, [&](std::size_t begin, std::size_t end) {
    CellWalk walk(vertices_, sets);
    for (std::size_t c = begin; c < end; ++c) findOnesOf(c, walk, candidates, pairs[c / cells_at_once]);
  });
  std::vector<Pair> all;
  for (const auto& part : pairs) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Each face is looked at in the cell of the site that has fewer faces.
void TiedEdges::findOnesOf(std::size_t cell, CellWalk& walk, const Candidates& candidates,
                           std::vector<Pair>& pairs) const {
  const Label site = vertices_.cells()[cell];
  const Row row = rowOf(rows_, site);
  walk.take(cell, row, [](std::uint32_t) { return false; });
  if (walk.names() == vertices_.of(cell).size()) return;
  for (std::size_t f = 0; f < row.faces; ++f) {
    const Label other = row.neighbor[f];
    if (!isWallLabel(other)) {
      const std::uint32_t faces = rowOf(rows_, other).faces;
      if (faces < row.faces || (faces == row.faces && other > site)) continue;
    }
    auto& steps = walk.walk(row, f, 0);
    if (steps.size() != 2 && !walk.visitsAgain()) continue;
    shorten(steps, [&](const RingStep& a, const RingStep& b) {
      std::uint32_t one = candidates.find(vertices_, labelsAround(row, site, a.edge_end)),
                    two = candidates.find(vertices_, labelsAround(row, site, b.edge_end));
      if (one == Candidates::none) std::swap(one, two);
      if (one != Candidates::none) pairs.push_back({one, two});
    });
  }
}

std::vector<std::uint32_t> TiedEdges::findWide(DisjointSets& sets) const {
  // An edge is not longer than its part of a tie of twice the vertex' radius.
  constexpr double unit = 1024, wide = 2 * unit;
  std::vector<std::uint32_t> length(edges_.empty() ? 0 : vertices_.size(), 0);
  const auto forJoined = [&](const auto& each) {
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const std::uint32_t root = sets.root(ends_[e].from);
      if (root == sets.root(ends_[e].to)) each(e, root);
    }
  };
  bool any = false;
  forJoined([&](std::uint32_t e, std::uint32_t root) {
    length[root] += static_cast<std::uint32_t>(std::ceil(edges_[e].part * unit));
    any = any || length[root] > wide;
  });
  if (!any) return {};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> joined;
  forJoined([&](std::uint32_t e, std::uint32_t root) {
    if (length[root] > wide) joined.emplace_back(root, e);
  });
  std::ranges::sort(joined);
  std::vector<std::uint32_t> found, edges;
  for (std::size_t k = 0; k < joined.size(); ++k) {
    edges.push_back(joined[k].second);
    if (k + 1 < joined.size() && joined[k + 1].first == joined[k].first) continue;
    if (isWide(edges)) found.push_back(joined[k].first);
    edges.clear();
  }
  return found;
}

/// Whether the ends of edges are farther apart than 4 ties of their radius, or twice the tie of an edge.
bool TiedEdges::isWide(std::span<const std::uint32_t> edges) const {
  std::array<double, 3> low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  double limit = 0;
  const Point3& origin = places_.sites[edges_[edges[0]].site];
  for (const auto e : edges) {
    const Label site = edges_[e].site;
    const Row row = rowOf(rows_, site);
    const EdgeAround around = edgeAround(row, edges_[e].edge_end);
    const Label face = row.neighbor[around.face], other = row.neighbor[around.other];
    const Point3& from = places_.sites[site];
    double radius = 0;
    for (const auto end : {around.before, around.after}) {
      double error = 0;
      const Point3 p = end == around.before
                           ? vertexPlace(places_, site, face, row.neighbor[end], other, &error)
                           : vertexPlace(places_, site, face, other, row.neighbor[end], &error);
      radius = std::hypot(p.x, p.y, p.z);
      const double at[3] = {p.x + (from.x - origin.x), p.y + (from.y - origin.y), p.z + (from.z - origin.z)};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], at[axis]);
        high[axis] = std::max(high[axis], at[axis]);
      }
    }
    limit = std::max({limit, 4 * tie_part * radius, 2 * tieOf(places_, edgeLabels(site, face, other))});
  }
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) > limit;
}

bool TiedEdges::makeFiner(DisjointSets& sets, std::span<const std::uint32_t> became) {
  std::vector<std::uint32_t> vertices;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [from, to] = ends_[e];
    if (!std::ranges::binary_search(became, sets.root(from)) &&
        !std::ranges::binary_search(became, sets.root(to)))
      continue;
    vertices.push_back(from);
    vertices.push_back(to);
    edges_[e].part = static_cast<float>(
        lengthInTies(places_, rows_, edges_[e], 0.1 * no_length * std::pow(step_of_fineness, finest)));
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  finer_.resize(vertices_.size(), 0);
  bool finer = false;
  for (const auto vertex : vertices) {
    if (!std::ranges::binary_search(became, sets.root(vertex)) || finer_[vertex] == finest) continue;
    ++finer_[vertex];
    finer = true;
  }
  return finer;
}

}  // namespace vorpipe::space
