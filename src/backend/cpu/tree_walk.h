/// One cell, found over the tree and clipped by the shared algorithm as it is found.
///
/// A site cuts the cell when a corner of the cell is nearer to that site than to its own. So a subtree can
/// be passed over if its box reaches into none of the circles around the corners through the cell's own site;
/// unlike the radius of security this certifies long thin cells, too. With weights, to be nearer is to have
/// the smaller power, |x - p|^2 - w, and the square of a circle's radius grows by how much the heaviest site
/// of the subtree is heavier than the cell's own. The walk begins in the site's own
/// leaf and climbs; what stands beside its way is tried, nearest first. Where that takes long, as on a curve,
/// of all that is left the site that cuts a corner deepest is looked for instead, until there is none.
///
/// Every corner is known up to its `noise`, a bound of the rounding errors, which grows as its two lines
/// get parallel. Sites that cut no corner by more than its noise are left out; what that may have changed
/// is bounded, and where the bound matters, the cell is `open`. It matters by the rule that an edge
/// shorter than a tie is none; see backend/tie.h.
///
/// The functions are in tree_walk_search.h, which is what to include.
#pragma once

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "backend/cpu/clipper.h"
#include "backend/cpu/ring.h"
#include "backend/cpu/tree.h"

namespace vorpipe::cpu {

/// The line of a wall that is none of the domain's: it bounds a part of a cell.
constexpr std::int32_t inner_wall = -5;

/// Of a slot that holds none.
constexpr std::int32_t no_line = std::numeric_limits<std::int32_t>::min();

template <class Real>
Real differenceOf(double a, double b) {
  return Real(a) - Real(b);
}

/// Seen from the origin of a cell; side k is one of the domain's unless inner[k].
template <class Real>
struct Walls {
  Real west, south, east, north;
  bool inner[4];  ///< west, east, south, north: as the numbers of the walls
};

/// What is inside the walls of a walk.
template <class Real>
struct Found {
  std::vector<RingEdge<Real>> edges;  ///< added to, in no order
  std::vector<std::int32_t> tried;    ///< where sites have weights: those that cut or might have, added to
  Real blur{};                        ///< by how much sites that were left out may have shortened an edge
  bool sure = true;                   ///< that no site was left out that might have an edge that counts
};

template <class Real, std::size_t Room>
class TreeWalk {
 public:
  TreeWalk(const SiteSet& sites, const SiteTree& tree)
      : sites_(sites), tree_(tree), shorter_side_(shorterSide(sites)) {
    if (!sites.grid.heaviest.empty()) heaviest_anywhere_ = sites.grid.heaviest.back();
  }

  /// Clips the part inside `walls` of the cell of a site, whose origin lies at -origin_offset from it.
  /// Returns certified, empty, overflow or unsecured.
  CellStatus find(std::uint32_t site, const Vector<Real>& origin_offset, const Walls<Real>& walls,
                  Found<Real>& found);

  /// A box that the cell of an overflow lies in, smaller than its walls if possible.
  [[nodiscard]] Walls<Real> bounds(Walls<Real> walls) const;

 private:
  using real = Real;  // a word of the shared files
  using Clip = Clipper<Real, Room>;
  using vec2 = typename Clip::vec2;
  using vec4 = typename Clip::vec4;

  struct Subtree {
    std::uint32_t node;
    SiteTree::Range range;
    Real reach;             ///< of its box, into the circle or circles that are asked about
    std::uint32_t version;  ///< of the cell then
  };

  /// Between the lines of two slots; the rest of a corner is in arrays, for loops that vectorize.
  struct Corner {
    std::size_t before, after;
    Real turn;   ///< sine of the angle between the lines
    bool known;  ///< no site of the subtree is nearer to it than the cell's own
  };

  /// The site that lies deepest inside the circle around a corner through the cell's own site, of those
  /// that surely do.
  struct Deepest {
    Real depth;  ///< difference of squared distances
    std::uint32_t rank;
    bool found;
  };

  struct Seen;

  void climb();
  bool tryAll(std::size_t beside);
  template <class Reach>
  auto children(const Subtree& parent, const Reach& reachOf) const;
  void tryNear(SiteTree::Range range);
  void tryLeaf(SiteTree::Range range);
  void tryRank(std::uint32_t rank);
  void tryDeepest(std::size_t beside);
  Deepest findDeepest(std::size_t corner, std::size_t beside);
  void searchLeaf(std::size_t corner, SiteTree::Range range, Deepest& deepest);
  bool isWorthwhile(std::size_t corner, const Subtree& subtree, const Deepest& deepest);
  bool isWorthwhile(const Subtree& subtree);
  void cut(const Offset<Real>& d, std::int32_t site);
  void findCorners();
  void placeCorner(std::size_t corner, std::size_t before, std::size_t after);
  [[nodiscard]] bool hasWeights() const { return !tree_.weight.empty(); }
  [[nodiscard]] Real weightDifference(double weight) const;
  [[nodiscard]] Offset<Real> offsetTo(std::uint32_t site) const;
  [[nodiscard]] Offset<Real> offsetToRank(std::uint32_t rank) const;
  [[nodiscard]] Real depthOf(std::size_t corner, const Offset<Real>& d) const;
  [[nodiscard]] Real reach(std::size_t corner, const Bounds& bounds) const;
  [[nodiscard]] Real reach(const Bounds& bounds) const;
  bool mayMatter(std::size_t corner, const Bounds& bounds, Real reached);
  bool mayMatter(std::size_t corner, const Offset<Real>& d);
  [[nodiscard]] bool liesIn(std::size_t slot, const Offset<Real>& d, Real length) const;
  [[nodiscard]] bool liesBehind(std::size_t slot, const Offset<Real>& d, Real length) const;
  void takeOver(std::uint32_t site);
  [[nodiscard]] Real noiseOf(std::size_t corner, const Offset<Real>& d) const;
  [[nodiscard]] bool isEdge(std::uint32_t site) const;
  [[nodiscard]] bool isCornerOf(std::size_t corner, std::uint32_t site) const;
  bool isCut(const Offset<Real>& d, bool& perhaps, bool& wholly) const;
  bool cutByDoubtful();
  [[nodiscard]] bool isKnownAround() const;
  [[nodiscard]] Real apart(std::size_t slot) const;
  CellStatus finish(Found<Real>& found);

  [[nodiscard]] bool isOver() const { return cell_.overflow || corners_ == 0; }

  const SiteSet& sites_;
  const SiteTree& tree_;
  double shorter_side_;  ///< of the domain
  Clip clip_;
  typename Clip::Cell cell_;
  std::uint32_t site_ = 0;
  double site_x_ = 0, site_y_ = 0, weight_ = 0;
  double heaviest_anywhere_ = -std::numeric_limits<double>::infinity();  // in the set or not, but heavy ones
  Vector<Real> origin_offset_;
  std::size_t corners_ = 0;
  std::size_t corners_end_ = 0;  // of loops that vectorize: what is beyond corners_ is computed in vain
  Corner corner_[Room];
  // By corner: the normal of the line before it; the noise along that line and across. The corner itself,
  // seen from the site; its squared distance from the site, and by how much that is unsure; the same for the
  // reach of a box.
  Real line_x_[Room], line_y_[Room], noise_[Room], across_[Room];
  Real x_[Room], y_[Room], squared_[Room], widening_[Room], margin_[Room];
  // By slot, while line_[k] is still the one in it.
  std::int32_t line_[Room];
  std::int32_t known_after_[Room];  // the line that its edge ends at, where that corner is known
  Real angle_[Room];                // of the normal
  Real moved_[Room], apart_[Room];  // as in RingEdge; apart_ of sites only
  Real new_moved_{}, new_apart_{};  // of the line that cuts
  std::vector<Subtree> beside_;     // the subtrees beside the way from the root to the site's leaf
  std::vector<Subtree> pending_;
  std::vector<std::pair<double, std::uint32_t>> nearest_;  // power of the cell's own site, and rank
  std::uint32_t version_ = 0;
  Real most_margin_{};
  std::vector<std::uint32_t> doubtful_;  // sites that cut the cell once, or might have
  bool surely_empty_ = false;
  Real blur_{};
};

}  // namespace vorpipe::cpu
