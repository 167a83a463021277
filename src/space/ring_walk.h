/// What remains of a ring when some of its vertices become one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vorpipe::space {

/// A step along a ring: across an edge to the next vertex.
struct RingStep {
  std::uint32_t edge_end;  ///< of the row; see RowVertices
  std::uint32_t to;        ///< a vertex, or its name
};

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
