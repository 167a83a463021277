#include "domain/edge_tree.h"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <iterator>
#include <limits>
#include <utility>

#include "geometry/predicates.h"

namespace vorpipe::core {
namespace {

namespace index = boost::geometry::index;

using TreePoint = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
using TreeBox = boost::geometry::model::box<TreePoint>;
using Leaf = std::pair<TreeBox, std::uint32_t>;

TreeBox treeBox(const Box& box) { return {{box.xmin, box.ymin}, {box.xmax, box.ymax}}; }

std::vector<Leaf> leavesOf(const Rings& rings) {
  std::vector<Leaf> leaves(rings.size());
  for (std::uint32_t e = 0; e < rings.size(); ++e) {
    const Point p = rings.points[e], q = rings.endOf(e);
    leaves[e] = {treeBox(boxAround(p, q)), e};
  }
  return leaves;
}

}  // namespace

struct OutlineIndex::Tree {
  explicit Tree(const Rings& rings) : edges(leavesOf(rings)) {
    for (const Point p : rings.points) xmax = std::max(xmax, p.x);
  }
  index::rtree<Leaf, index::quadratic<16>> edges;
  double xmax = -std::numeric_limits<double>::infinity();
};

OutlineIndex::OutlineIndex(const Rings& rings) : rings_(rings), tree_(std::make_unique<Tree>(rings)) {}
OutlineIndex::~OutlineIndex() = default;

void OutlineIndex::edgesIn(const Box& box, std::vector<std::uint32_t>& edges) const {
  edges.clear();
  for (auto leaf = tree_->edges.qbegin(index::intersects(treeBox(box))); leaf != tree_->edges.qend();
       ++leaf) {
    edges.push_back(leaf->second);
  }
  std::ranges::sort(edges);
}

int OutlineIndex::turnsAround(Point p) const {
  if (!(p.x <= tree_->xmax)) return 0;
  int turns = 0;
  const TreeBox ray = treeBox({p.x, p.y, tree_->xmax, p.y});
  for (auto leaf = tree_->edges.qbegin(index::intersects(ray)); leaf != tree_->edges.qend(); ++leaf) {
    const Point a = rings_.points[leaf->second], b = rings_.endOf(leaf->second);
    if (crossesRay(a, b, p)) turns += b.y > a.y ? 1 : -1;
  }
  return turns;
}

bool OutlineIndex::isOnEdge(Point p) const {
  // Within the box of an edge, a point on its line lies on the edge.
  return std::any_of(tree_->edges.qbegin(index::intersects(treeBox({p.x, p.y, p.x, p.y}))),
                     tree_->edges.qend(), [&](const Leaf& leaf) {
                       const auto e = leaf.second;
                       return orientation(rings_.points[e], rings_.endOf(e), p) == 0;
                     });
}

}  // namespace vorpipe::core
