#include <algorithm>
#include <cmath>

#include "vorpipe/topology.h"

namespace vorpipe {
namespace {

/// Whether b is hidden, or no more than touched, between a and c on a line: heights are those of the
/// paraboloid less the weights.
bool isHidden(const Point& a, const Point& b, const Point& c) {
  return (b.y - a.y) * (c.x - b.x) >= (c.y - b.y) * (b.x - a.x);
}

/// Pairs of sites that follow each other, of sites that all lie on a line. Those that a heavier one hides
/// have none.
std::vector<SitePair> pairsOnLine(const Sites& sites, const Diagram& diagram) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (diagram.owner[i] == i) order.push_back(i);
  }
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair(sites.x[i], sites.y[i]); });
  if (!sites.weight.empty() && order.size() > 2) {
    const std::uint32_t first = order.front();
    const auto lifted = [&](std::uint32_t i) {
      const double along = std::hypot(sites.x[i] - sites.x[first], sites.y[i] - sites.y[first]);
      return Point{along, along * along - sites.weight[i]};
    };
    std::size_t kept = 0;
    for (const std::uint32_t site : order) {
      while (kept > 1 && isHidden(lifted(order[kept - 2]), lifted(order[kept - 1]), lifted(site))) --kept;
      order[kept++] = site;
    }
    order.resize(kept);
  }
  std::vector<SitePair> pairs;
  for (std::size_t k = 1; k < order.size(); ++k) {
    pairs.push_back({std::min(order[k - 1], order[k]), std::max(order[k - 1], order[k])});
  }
  return pairs;
}

}  // namespace

std::vector<SitePair> triangulationEdges(const Sites& sites, const Diagram& diagram) {
  std::vector<SitePair> pairs;
  if (diagram.triangles.empty() && !diagram.solid_angle.empty()) {
    // Slices of the globe follow each other around a circle.
    for (const Cell cell : diagram) {
      for (const std::int64_t other : cell.neighbors()) {
        const auto a = static_cast<std::uint32_t>(cell.index()), b = static_cast<std::uint32_t>(other);
        pairs.push_back({std::min(a, b), std::max(a, b)});
      }
    }
  } else if (diagram.triangles.empty()) {
    pairs = pairsOnLine(sites, diagram);
  } else {
    constexpr std::size_t sides = 3;
    pairs.reserve(diagram.triangles.size() * sides);
    for (const auto& triangle : diagram.triangles) {
      for (std::size_t k = 0; k < sides; ++k) {
        const std::uint32_t a = triangle[k], b = triangle[(k + 1) % sides];
        pairs.push_back({std::min(a, b), std::max(a, b)});
      }
    }
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace vorpipe
