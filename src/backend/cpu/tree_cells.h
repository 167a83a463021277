/// Finds cells with any number of edges by walking the tree.
#pragma once

#include <memory>

#include "backend/cpu/tree_walk_search.h"

namespace vorpipe::cpu {

/// Finds one cell after the other, with numbers of type Real.
template <class Real>
class CellFinder {
 public:
  CellFinder(const SiteSet& sites, const SiteTree& tree) : sites_(sites), tree_(tree), usual_(sites, tree) {}

  /// Appends the neighbors of a site, counter-clockwise. Returns certified, empty, unsecured, or open if
  /// rounding leaves doubts; with `decide`, doubtful cases count as ties. For a cell that is empty in a set
  /// with weights, appends what leaves nothing of it, as CellNeighbors describes.
  CellStatus find(std::uint32_t site, std::vector<std::int32_t>& neighbors, bool decide) {
    const auto status = findEdges(site, decide);
    if (status == CellStatus::certified) {
      // Ties are kept: corners are computed from the neighbors beside them.
      for (const auto& edge : found_.edges) neighbors.push_back(edge.line);
    } else if (status == CellStatus::empty && hasWeights()) {
      appendTried(neighbors);
    }
    return status;
  }

 private:
  static constexpr std::size_t usual_edges = 12;
  static constexpr std::size_t part_edges = 64;
  /// Parts are halved at most this often: smaller ones are below rounding.
  static constexpr int most_halvings = 200;

  [[nodiscard]] bool hasWeights() const { return !tree_.weight.empty(); }

  CellStatus findEdges(std::uint32_t site, bool decide) {
    found_.edges.clear();
    found_.tried.clear();
    found_.blur = Real(0.0);
    found_.sure = true;
    const auto& domain = sites_.domain;
    const double x = std::clamp(sites_.x[site], domain.xmin, domain.xmax);
    const double y = std::clamp(sites_.y[site], domain.ymin, domain.ymax);
    origin_offset_ = {Real(sites_.x[site]) - Real(x), Real(sites_.y[site]) - Real(y)};
    const Walls<Real> walls{Real(domain.xmin) - Real(x),
                            Real(domain.ymin) - Real(y),
                            Real(domain.xmax) - Real(x),
                            Real(domain.ymax) - Real(y),
                            {}};
    auto status = usual_.find(site, origin_offset_, walls, found_);
    if (status == CellStatus::overflow) {
      status = findParts(site, usual_.bounds(walls), 0);
      joinParts();
    }
    if (status == CellStatus::unsecured) return status;
    if (!found_.sure && !decide) return CellStatus::open;
    sortRing(found_.edges);
    const auto& edges = found_.edges;
    if (edges.empty()) return CellStatus::empty;
    if (mayBeEmpty(edges, origin_offset_)) return decide ? CellStatus::empty : CellStatus::open;
    if (!isSure(edges, origin_offset_, found_.blur, shorterSide(sites_)) && !decide) return CellStatus::open;
    return CellStatus::certified;
  }

  /// The sites that cut the cell or touched it, and the walls.
  void appendTried(std::vector<std::int32_t>& neighbors) {
    auto& tried = found_.tried;
    std::sort(tried.begin(), tried.end());
    tried.erase(std::unique(tried.begin(), tried.end()), tried.end());
    for (std::int32_t wall = WALL_YMAX; wall <= WALL_XMIN; ++wall) neighbors.push_back(wall);
    neighbors.insert(neighbors.end(), tried.begin(), tried.end());
  }

  /// Clips the part of a cell inside walls, in as many parts as necessary.
  CellStatus findParts(std::uint32_t site, const Walls<Real>& walls, int halvings) {
    if (!part_) part_ = std::make_unique<TreeWalk<Real, part_edges>>(sites_, tree_);
    auto status = part_->find(site, origin_offset_, walls, found_);
    if (status != CellStatus::overflow) return status;
    if (halvings == most_halvings) {
      found_.sure = false;
      return CellStatus::certified;
    }
    const auto [low, high] = halves(part_->bounds(walls));
    status = findParts(site, low, halvings + 1);
    return status == CellStatus::unsecured ? status : findParts(site, high, halvings + 1);
  }

  /// Does not split at the middle, where the edges of a symmetric cell may lie on the new wall.
  static std::pair<Walls<Real>, Walls<Real>> halves(const Walls<Real>& walls) {
    constexpr double place = 0.4142;
    auto low = walls;
    auto high = walls;
    const Real width = walls.east - walls.west;
    const Real height = walls.north - walls.south;
    if (width >= height) {
      low.east = high.west = walls.west + width * Real(place);
      low.inner[1] = high.inner[0] = true;
    } else {
      low.north = high.south = walls.south + height * Real(place);
      low.inner[3] = high.inner[2] = true;
    }
    return {low, high};
  }

  /// Joins the pieces of edges that parts share.
  void joinParts() {
    auto& edges = found_.edges;
    std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (kept > 0 && edges[kept - 1].line == edges[k].line) {
        auto& whole = edges[kept - 1];
        whole.lo = min(whole.lo, edges[k].lo);
        whole.hi = max(whole.hi, edges[k].hi);
      } else {
        edges[kept++] = edges[k];
      }
    }
    edges.resize(kept);
  }

  const SiteSet& sites_;
  const SiteTree& tree_;
  TreeWalk<Real, usual_edges> usual_;
  std::unique_ptr<TreeWalk<Real, part_edges>> part_;
  Vector<Real> origin_offset_;
  Found<Real> found_;
};

/// Finds the neighborhoods of the sites `which` in double; `open` where double does not decide.
void findInDouble(const SiteSet& sites, const SiteTree& tree, std::span<const std::uint32_t> which,
                  int threads, CellNeighbors& out);

}  // namespace vorpipe::cpu
