/// What remains of a ring when some of its vertices become one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/disjoint_sets.h"
#include "space/shared_vertices.h"

namespace vorpipe::space {

/// A step along a ring: across an edge to the next vertex.
struct RingStep {
  std::uint32_t edge_end;  ///< of the row; see RowVertices
  std::uint32_t to;        ///< a vertex
};

/// The steps along the ring of a face between vertices that are not one, from the k-th edge end on.
/// isNone(v): the ring goes straight on at vertex v.
template <class IsNone>
void walkRing(const SharedVertices& vertices, DisjointSets& sets, const IsNone& isNone, std::size_t cell,
              const Row& row, std::size_t face, std::size_t k, std::vector<RingStep>& steps) {
  steps.clear();
  const std::size_t begin = row.ringBegin(face), n = row.ringBegin(face + 1) - begin;
  for (std::size_t step = 0; step < n; ++step) {
    const std::uint32_t to = sets.root(vertices.at(cell, begin + k));
    if (!isNone(to) && (steps.empty() || steps.back().to != to))
      steps.push_back({static_cast<std::uint32_t>(begin + k), to});
    k = k + 1 == n ? 0 : k + 1;
  }
  while (steps.size() > 1 && steps.back().to == steps.front().to) steps.erase(steps.begin());
  if (steps.size() == 1) steps.clear();
}

/// Shortens a closed walk, of which each step ends in another vertex than the one before, the last before the
/// first. Where it goes to a vertex and straight back, the two edges are one and go: onePair(a, b) hears of
/// them. What remains does not depend on where the ring begins, or on the direction, but for where it begins.
/// It has no steps, or three or more.
template <class OnePair>
void shorten(std::vector<RingStep>& steps, const OnePair& onePair) {
  if (steps.empty()) return;
  std::uint32_t base = steps.back().to;
  std::size_t kept = 0;
  const auto from = [&](std::size_t step) { return step == 0 ? base : steps[step - 1].to; };
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const RingStep step = steps[k];
    if (kept > 0 && step.to == from(kept - 1)) {
      onePair(steps[--kept], step);
    } else {
      steps[kept++] = step;
    }
  }
  std::size_t first = 0;
  while (kept - first >= 2 && steps[first].to == steps[kept - 2].to) {
    onePair(steps[first], steps[kept - 1]);
    ++first;
    --kept;
  }
  steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(kept), steps.end());
  steps.erase(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace vorpipe::space
