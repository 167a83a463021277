#include "globe/sphere_cells.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "backend/tie.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/refusal.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t cells_grain = 4096;

/// The direction in which three sites share a vertex.
struct Center {
  Direction at;
  double rounding;  ///< how far rounding may move it, in radians
};

/// At right angles to the plane through the three vectors. Near a site it is that site's direction p plus the
/// part of a vector at right angles to that plane: (p + u) . (v - w) = 0 for its vector v and both others, w.
/// That keeps the digits of sites that are near to each other.
Center centerOf(const SphereSites& sites, const std::array<std::uint32_t, 3>& t) {
  constexpr double few = 8, near = 0.5, epsilon = std::numeric_limits<double>::epsilon();
  const auto vectors = sites.vectors();
  const Direction a = vectors[t[1]] - vectors[t[0]], b = vectors[t[2]] - vectors[t[0]];
  const Direction across = cross(a, b);
  const double size = lengthOf(across), longest = std::max(lengthOf(a), lengthOf(b));
  const auto depth = [&](std::uint32_t site) { return depthOf(sites, t[0], site); };
  const Direction way = 1 / (size * size) * (depth(t[1]) * cross(b, across) + depth(t[2]) * cross(across, a));
  if (lengthOf(way) < near && dot(sites.direction[t[0]], across) > 0) {
    return {normalized(sites.direction[t[0]] + way), few * epsilon * (1 + longest * longest / size)};
  }
  return {1 / size * across, few * epsilon * longest / size};
}

/// The triangles around each site: one that has the sites `first` and `second` after it, counter-clockwise.
struct Corner {
  std::uint32_t triangle, first, second;
};

class Rows {
 public:
  Rows(const SphereSites& sites, const SphereMesh& mesh, int threads)
      : sites_(sites),
        vectors_(sites.vectors()),
        mesh_(mesh),
        threads_(threads),
        joined_(mesh.triangles.size()) {}

  Result<SphereCells> run() {
    findCenters();
    listCorners();
    eachSite([this](std::size_t site) { sortAround(site); });
    eachSite([this](std::size_t site) { joinTies(site); });
    settleCenters();
    return write();
  }

 private:
  template <class Work>
  void eachSite(const Work& work) {
    parallelFor(vectors_.size(), cells_grain, threads_, [&](std::size_t begin, std::size_t end) {
      for (auto site = begin; site < end; ++site) work(site);
    });
  }

  void findCenters() {
    centers_.resize(mesh_.triangles.size());
    parallelFor(centers_.size(), cells_grain, threads_, [&](std::size_t begin, std::size_t end) {
      for (auto t = begin; t < end; ++t) centers_[t] = centerOf(sites_, mesh_.triangles[t]);
    });
  }

  void listCorners() {
    offsets_.assign(vectors_.size() + 1, 0);
    for (const auto& t : mesh_.triangles) {
      for (const auto site : t) ++offsets_[site + std::size_t{1}];
    }
    for (std::size_t i = 0; i < vectors_.size(); ++i) offsets_[i + 1] += offsets_[i];
    corners_.resize(offsets_.back());
    auto next = offsets_;
    for (std::uint32_t k = 0; k < mesh_.triangles.size(); ++k) {
      const auto& t = mesh_.triangles[k];
      for (std::size_t c = 0; c < t.size(); ++c) {
        corners_[next[t[c]]++] = {k, t[(c + 1) % 3], t[(c + 2) % 3]};
      }
    }
  }

  [[nodiscard]] std::span<Corner> cornersOf(std::size_t site) {
    return std::span(corners_).subspan(offsets_[site], offsets_[site + 1] - offsets_[site]);
  }

  /// Sorts the triangles around a site counter-clockwise, from that of its lowest neighbor.
  void sortAround(std::size_t site) {
    const auto around = cornersOf(site);
    if (around.empty()) return;
    std::ranges::sort(around, {}, &Corner::first);
    std::vector<Corner> turn{around.front()};
    while (turn.size() < around.size()) {
      turn.push_back(*std::ranges::lower_bound(around, turn.back().second, {}, &Corner::first));
    }
    std::ranges::copy(turn, around.begin());
  }

  /// The edge to neighbor corner k's `first` begins in the triangle before.
  static const Corner& before(std::span<const Corner> around, std::size_t k) {
    return around[k > 0 ? k - 1 : around.size() - 1];
  }

  void joinTies(std::size_t site) {
    const auto around = cornersOf(site);
    for (std::size_t k = 0; k < around.size(); ++k) {
      const auto other = around[k].first;
      if (other < site) continue;
      const auto t = before(around, k).triangle, next = around[k].triangle;
      const Center &a = centers_[t], &b = centers_[next];
      const double length = lengthOf(b.at - a.at);
      const double tie = shortest_edge * lengthOf(vectors_[other] - vectors_[site]);
      if (length <= std::max(tie, a.rounding + b.rounding)) joined_.join(t, next);
    }
  }

  /// Centers that ties join are where the one is that rounding moves least.
  void settleCenters() {
    const auto count = static_cast<std::uint32_t>(centers_.size());
    std::vector<std::uint32_t> best(count);
    for (std::uint32_t t = 0; t < count; ++t) {
      const auto root = joined_.root(t);
      if (root == t || centers_[t].rounding < centers_[best[root]].rounding) best[root] = t;
    }
    vertex_.resize(count);
    for (std::uint32_t t = 0; t < count; ++t) vertex_[t] = centers_[best[joined_.root(t)]].at;
  }

  /// Whether the edge to corner k's `first` is a tie.
  [[nodiscard]] bool isTie(std::span<const Corner> around, std::size_t k) {
    return joined_.root(before(around, k).triangle) == joined_.root(around[k].triangle);
  }

  Result<SphereCells> write() {
    SphereCells cells;
    cells.offsets.assign(vectors_.size() + 1, 0);
    eachSite([&](std::size_t site) {
      const auto around = cornersOf(site);
      for (std::size_t k = 0; k < around.size(); ++k) cells.offsets[site + 1] += isTie(around, k) ? 0u : 1u;
    });
    for (std::size_t i = 0; i < vectors_.size(); ++i) {
      const bool has_cell = offsets_[i + 1] > offsets_[i];
      if (has_cell && cells.offsets[i + 1] < 2) {
        return tl::unexpected(refusalOf(
            Subject::sites, fmt::format("site {} is so near to others that rounding leaves it no edge", i)));
      }
      cells.offsets[i + 1] += cells.offsets[i];
    }
    cells.neighbor.resize(cells.offsets.back());
    cells.vertex.resize(cells.offsets.back());
    eachSite([&](std::size_t site) {
      const auto around = cornersOf(site);
      auto out = cells.offsets[site];
      for (std::size_t k = 0; k < around.size(); ++k) {
        if (isTie(around, k)) continue;
        cells.neighbor[out] = around[k].first;
        cells.vertex[out++] = vertex_[before(around, k).triangle];
      }
    });
    return cells;
  }

  const SphereSites& sites_;
  std::span<const Direction> vectors_;
  const SphereMesh& mesh_;
  int threads_;
  DisjointSets joined_;
  std::vector<Center> centers_;
  std::vector<Direction> vertex_;  ///< by triangle
  std::vector<std::uint64_t> offsets_;
  std::vector<Corner> corners_;
};

/// The axis of a circle through sites: at right angles to the chords from the first, of which it takes those
/// that enclose the largest triangle.
Direction axisOf(std::span<const Direction> sites, const std::vector<std::uint32_t>& circle) {
  const Direction& from = sites[circle.front()];
  const auto chord = [&](std::uint32_t site) { return sites[site] - from; };
  const auto farthest =
      *std::ranges::max_element(circle, {}, [&](auto site) { return lengthOf(chord(site)); });
  const Direction along = chord(farthest);
  const auto widest =
      *std::ranges::max_element(circle, {}, [&](auto site) { return lengthOf(cross(along, chord(site))); });
  return normalized(cross(along, chord(widest)));
}

/// The cells of sites on one circle: slices that meet at its two poles.
SphereCells slices(std::span<const Direction> sites, const std::vector<std::uint32_t>& circle) {
  SphereCells cells;
  const auto count = circle.size();
  std::vector<std::uint32_t> at(sites.size(), no_site);
  for (std::uint32_t k = 0; k < count; ++k) at[circle[k]] = k;
  const Direction axis = count == 2 ? perpendicular(normalized(sites[std::min(circle[0], circle[1])] -
                                                               sites[std::max(circle[0], circle[1])]))
                                    : axisOf(sites, circle);
  cells.offsets.push_back(0);
  for (std::size_t site = 0; site < sites.size(); ++site) {
    const auto k = at[site];
    if (k != no_site && count == 2) {
      cells.neighbor.push_back(circle[1 - k]);
      cells.vertex.push_back(axis);
    } else if (k != no_site && count > 2) {
      std::array<std::uint32_t, 2> around{circle[k > 0 ? k - 1 : count - 1],
                                          circle[k + 1 < count ? k + 1 : 0]};
      std::ranges::sort(around);
      for (const auto other : around) {
        // Around the site, the edge runs counter-clockwise about the way from its neighbor.
        const auto next = around[other == around[0] ? 1 : 0];
        const Direction turn = cross(sites[site] - sites[other], sites[site] - sites[next]);
        cells.neighbor.push_back(other);
        cells.vertex.push_back(dot(turn, axis) > 0 ? -axis : axis);
      }
    }
    cells.offsets.push_back(cells.neighbor.size());
  }
  return cells;
}

}  // namespace

Result<SphereCells> cellsOfSphere(const SphereSites& sites, const SphereMesh& mesh, int threads) {
  if (!mesh.circle.empty()) return slices(sites.vectors(), mesh.circle);
  return Rows(sites, mesh, threads).run();
}

Arc arcOf(std::span<const Direction> sites, const SphereCells& cells, std::size_t site, std::uint64_t edge) {
  const auto next = edge + 1 < cells.offsets[site + 1] ? edge + 1 : cells.offsets[site];
  return arcBetween(sites[site], sites[cells.neighbor[edge]], cells.vertex[edge], cells.vertex[next],
                    next == edge);
}

Arc arcBetween(const Direction& site, const Direction& neighbor, const Direction& begin, const Direction& end,
               bool is_sole) {
  constexpr double nearly_half = 3;
  const Direction between = normalized(site - neighbor);
  if (is_sole) return {begin, end, between, 2 * std::numbers::pi};
  const double angle = angleBetween(begin, end);
  return {begin, end, angle > 0 && angle < nearly_half ? normalized(cross(begin, end)) : between, angle};
}

Direction pointOn(const Arc& arc, double fraction) {
  const double angle = fraction * arc.angle;
  return std::cos(angle) * arc.begin + std::sin(angle) * cross(arc.axis, arc.begin);
}

}  // namespace vorpipe::core
