#include "space/tied_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "space/place.h"
#include "space/ring_walk.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t edges_at_once = 1024;
/// Each step divides the length of ties by 64; after the last they are as short as rounding errors.
constexpr std::uint8_t finest = 5;
constexpr double step_of_fineness = 1.0 / 64;

Row rowOf(const Rows& rows, Label site) { return rows[static_cast<std::size_t>(site)]; }

/// Where a third stands in the ring of a face.
std::size_t placeIn(const Ring& ring, std::size_t third) {
  std::size_t k = 0;
  while (ring[k] != third) ++k;
  return k;
}

}  // namespace

TiedEdges::Ends TiedEdges::endsOf(const ShortEdge& edge) const {
  const Row row = rowOf(rows_, edge.site);
  const std::size_t cell = vertices_.cellOf(edge.site);
  return {vertices_.at(cell, edgeAround(row, edge.edge_end).end_before), vertices_.at(cell, edge.edge_end)};
}

EdgeLabels TiedEdges::labelsOf(Label site, std::size_t edge_end) const {
  const Row row = rowOf(rows_, site);
  const EdgeAround around = edgeAround(row, edge_end);
  return edgeLabels(site, row.neighbor[around.face], row.neighbor[around.other]);
}

double TiedEdges::finenessAt(const Ends& ends) const {
  if (finer_.empty()) return 1;
  const auto at = [&](std::uint32_t vertex) {
    const auto found = finer_.find(vertex);
    return found == finer_.end() ? 0 : static_cast<int>(found->second);
  };
  return std::pow(step_of_fineness, std::max(at(ends.from), at(ends.to)));
}

std::uint64_t TiedEdges::join(DisjointSets& sets) {
  const std::size_t blocks = (edges_.size() + edges_at_once - 1) / edges_at_once;
  std::vector<std::vector<std::uint32_t>> longer(blocks);
  parallelFor(edges_.size(), edges_at_once, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const Ends ends = endsOf(edges_[e]);
      const double fineness = finenessAt(ends);
      if (edges_[e].part <= no_length * fineness) {
        sets.join(ends.from, ends.to);
      } else if (edges_[e].part <= fineness) {
        longer[e / edges_at_once].push_back(static_cast<std::uint32_t>(e));
      }
    }
  });
  std::vector<std::uint32_t> candidates;
  for (const auto& part : longer) candidates.insert(candidates.end(), part.begin(), part.end());
  std::uint64_t ties = 0;
  for (const auto& edge : edges_)
    ties += edge.part <= no_length * finenessAt(finer_.empty() ? Ends{} : endsOf(edge));
  if (candidates.empty()) return ties;

  std::vector<std::pair<EdgeLabels, std::uint32_t>> sorted;
  for (const auto e : candidates) sorted.emplace_back(labelsOf(edges_[e].site, edges_[e].edge_end), e);
  std::ranges::sort(sorted);
  std::vector<EdgeLabels> labels;
  for (std::size_t c = 0; c < sorted.size(); ++c) {
    labels.push_back(sorted[c].first);
    candidates[c] = sorted[c].second;
  }
  EdgeClasses classes(std::move(labels));
  joinOnes(sets, candidates, classes);
  // The sites around edges that are one lie on a circle, where the two nearest stand side by side, around one
  // of the edges: a class is not longer than their tie if each of its edges is not longer than its own.
  for (std::uint32_t c = 0; c < candidates.size(); ++c) {
    if (!classes.isWhole(c)) continue;
    const Ends ends = endsOf(edges_[candidates[c]]);
    sets.join(ends.from, ends.to);
    ++ties;
  }
  return ties;
}

/// Joins those candidates that are one with another edge, at each of the faces beside them.
void TiedEdges::joinOnes(DisjointSets& sets, const std::vector<std::uint32_t>& candidates,
                         EdgeClasses& classes) const {
  const std::size_t blocks = (candidates.size() + edges_at_once - 1) / edges_at_once;
  std::vector<std::vector<std::array<EdgeLabels, 2>>> pairs(blocks);
  parallelFor(candidates.size(), edges_at_once, threads_, [&](std::size_t begin, std::size_t end) {
    std::vector<RingStep> steps;
    for (std::size_t c = begin; c < end; ++c) {
      const EdgeLabels labels = classes.edges()[c];
      for (std::size_t out = 0; out < 3; ++out) {
        // The face between two of the labels, in the cell of the site that has fewer faces.
        Label other = labels[out == 0 ? 1 : 0], site = labels[out == 2 ? 1 : 2];
        if (isWallLabel(site)) continue;
        if (!isWallLabel(other) && rowOf(rows_, other).faces < rowOf(rows_, site).faces)
          std::swap(other, site);
        const Row row = rowOf(rows_, site);
        const std::size_t face = row.faceOf(other), third = row.faceOf(labels[out]);
        const auto own = static_cast<std::uint32_t>(row.ringBegin(face) + placeIn(row.ring(face), third));
        walkRing(
            vertices_, sets, [](auto) { return false; }, vertices_.cellOf(site), row, face, 0, steps);
        shorten(steps, [&](const RingStep& a, const RingStep& b) {
          if (a.edge_end != own && b.edge_end != own) return;
          const std::uint32_t one = a.edge_end == own ? b.edge_end : a.edge_end;
          pairs[c / edges_at_once].push_back({labels, labelsOf(site, one)});
        });
      }
    }
  });
  for (const auto& part : pairs) {
    for (const auto& [edge, other] : part) classes.join(edge, other);
  }
}

std::vector<std::uint32_t> TiedEdges::findWide(DisjointSets& sets) const {
  // An edge is not longer than its part of a tie of twice the vertex' radius.
  constexpr double unit = 1024, wide = 2 * unit;
  std::vector<std::uint32_t> length(edges_.empty() ? 0 : vertices_.size(), 0);
  const auto forJoined = [&](const auto& each) {
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const Ends ends = endsOf(edges_[e]);
      const std::uint32_t root = sets.root(ends.from);
      if (root == sets.root(ends.to)) each(e, root);
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
  for (auto& edge : edges_) {
    const Ends ends = endsOf(edge);
    const std::uint32_t root = sets.root(ends.from);
    if (!std::ranges::binary_search(became, root) && !std::ranges::binary_search(became, sets.root(ends.to)))
      continue;
    vertices.push_back(ends.from);
    vertices.push_back(ends.to);
    edge.part = static_cast<float>(
        lengthInTies(places_, rows_, edge, 0.1 * no_length * std::pow(step_of_fineness, finest)));
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  bool finer = false;
  for (const auto vertex : vertices) {
    if (!std::ranges::binary_search(became, sets.root(vertex))) continue;
    auto& steps = finer_[vertex];
    if (steps == finest) continue;
    ++steps;
    finer = true;
  }
  return finer;
}

}  // namespace vorpipe::space
