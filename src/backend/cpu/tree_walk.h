/// Finds one cell by walking the tree, and clips it with the shared algorithm on the way.
///
/// A site cuts the cell when a corner of the cell is nearer to that site than to its own. So a subtree can be
/// skipped if its box reaches into none of the circles around the corners through the cell's own site. Unlike
/// the security radius, this certifies long thin cells, too. With weights, nearer means a smaller |x - p|^2 -
/// w, the power, and the square of a circle's radius grows by how much the heaviest site of the subtree is
/// heavier than the cell's own. The walk begins in the site's own leaf and climbs; subtrees beside its path
/// are tried, nearest first. Where that takes long, as on a curve, it instead searches all the rest for the
/// site that cuts a corner deepest, until there is none.
///
/// Every corner is known up to its `noise`, a bound of the rounding errors, which grows as its two lines get
/// parallel. Sites that cut no corner by more than its noise are left out. The effect of leaving them out is
/// bounded, and where the bound matters, the cell is `open`. What matters follows from the rule that an edge
/// shorter than a tie does not count; see backend/tie.h.
///
/// The functions are in tree_walk_search.h, which is the file to include.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "backend/cpu/clipper.h"
#include "backend/cpu/glsl.h"
#include "backend/cpu/tree.h"
#include "backend/tie.h"

namespace vorpipe::cpu {

/// An edge of a cell, as in struct Cell of cell.glsl.
template <class Real>
struct RingEdge {
  std::int32_t line;  ///< the site or wall whose line it is
  Real nx, ny, h, lo, hi;
  Real angle;  ///< of the normal, by pseudoAngle
  Real moved;  ///< how far the difference of weights moves the line, in either direction
  Real apart;  ///< the distance between the sites, or between a site and its image behind a wall
};

/// A vector of the plane.
template <class Real>
struct Vector {
  Real x{}, y{};
};

/// Another site, as seen from the cell's own.
template <class Real>
struct Offset {
  Real x, y;
  Real weight_difference;  ///< the weight of the cell's own site minus the other's
};

/// A site that was left out has no edge with the cell if the edge could be no longer than this: a fraction
/// of tieScale, like shortest_edge.
constexpr double no_edge = 5e-7;
/// Lengths with less uncertainty than this are accepted to tell an edge from a tie.
constexpr double unsure_edge = 5e-8;

/// Bounds how far rounding may have moved the intersection of two lines; `turn` is the sine of their angle.
/// near: the sum of the lines' heights, of how far weights moved them, and of the site's distance from the
/// origin; far: the point's distance from the origin. With u the unit of rounding, a normal is off by 2 u in
/// direction and 5 u in length, a height by 3 u, sine and cosine by 6 u. So the place on a line, (h - h_k
/// cosine) / sine, is off by at most (24 near + 8 far) u / sine.
template <class Real>
Real cornerNoise(Real near, Real far, Real turn) {
  using real = Real;
  const Real u = Real(ROUNDING);
  const Real rounding = u * (Real(24.0) * near + Real(8.0) * far);
  return turn > Real(8.0) * u ? rounding / turn : near + far;
}

template <class Real>
void sortRing(std::vector<RingEdge<Real>>& ring) {
  std::sort(ring.begin(), ring.end(), [](const auto& a, const auto& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.line < b.line;
  });
}

/// Returns the end point of an edge.
template <class Real>
Vector<Real> endOf(const RingEdge<Real>& edge) {
  return {edge.nx * edge.h - edge.ny * edge.hi, edge.ny * edge.h + edge.nx * edge.hi};
}

/// Bounds how far rounding may have moved the corner between an edge and the next.
template <class Real>
Real noiseBetween(const RingEdge<Real>& a, const RingEdge<Real>& b, const Vector<Real>& origin_offset) {
  const auto corner = endOf(a);
  const Real near = abs(a.h) + a.moved + abs(b.h) + b.moved + abs(origin_offset.x) + abs(origin_offset.y);
  return cornerNoise<Real>(near, abs(corner.x) + abs(corner.y), a.nx * b.ny - a.ny * b.nx);
}

/// Whether the sorted ring is no wider than the uncertainty of its corners: then it may be empty.
template <class Real>
bool mayBeEmpty(const std::vector<RingEdge<Real>>& ring, const Vector<Real>& origin_offset) {
  const auto count = ring.size();
  for (const auto& edge : ring) {
    bool is_thin = true;
    for (std::size_t k = 0; k < count && is_thin; ++k) {
      const auto corner = endOf(ring[k]);
      const Real inside = edge.h - (corner.x * edge.nx + corner.y * edge.ny);
      is_thin = inside <= Real(2.0) * noiseBetween(ring[k], ring[(k + 1) % count], origin_offset);
    }
    if (is_thin) return true;
  }
  return false;
}

/// Whether the sorted edges go around once and every length is precise enough to tell an edge from a tie.
/// blur bounds what else may have shortened an edge; shorter_side is the domain's.
template <class Real>
bool isSure(const std::vector<RingEdge<Real>>& ring, const Vector<Real>& origin_offset, Real blur,
            double shorter_side) {
  const auto count = ring.size();
  const auto cornerAfter = [&](std::size_t k) {
    const auto& a = ring[k];
    const auto& b = ring[(k + 1) % count];
    const auto corner = endOf(a);
    const Real noise = noiseBetween(a, b, origin_offset);
    const Real gap_x = b.nx * b.h - b.ny * b.lo - corner.x;
    const Real gap_y = b.ny * b.h + b.nx * b.lo - corner.y;
    return std::pair{noise, abs(gap_x) + abs(gap_y) <= Real(4.0) * noise};
  };
  auto before = cornerAfter(count - 1).first;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& edge = ring[k];
    const auto [after, closed] = cornerAfter(k);
    const Real scale = tieScale(edge.apart, shorter_side);
    const Real unsure = before + after + blur;
    const Real length = edge.hi - edge.lo;
    const bool is_edge = length - unsure > Real(shortest_edge) * scale;
    const bool is_tie = length + unsure < Real(shortest_edge) * scale;
    if (!closed || (!is_edge && !is_tie && unsure >= Real(unsure_edge) * scale)) return false;
    before = after;
  }
  return count >= 3;
}

/// The line of a wall that is not the domain's: it bounds a part of a cell.
constexpr std::int32_t inner_wall = -5;

/// The line of an empty slot.
constexpr std::int32_t no_line = std::numeric_limits<std::int32_t>::min();

template <class Real>
Real differenceOf(double a, double b) {
  return Real(a) - Real(b);
}

/// Walls relative to the origin of a cell; side k is one of the domain's unless inner[k].
template <class Real>
struct Walls {
  Real west, south, east, north;
  bool inner[4];  ///< west, east, south, north: as the numbers of the walls
};

/// What a walk finds inside its walls.
template <class Real>
struct Found {
  std::vector<RingEdge<Real>> edges;  ///< appended, in no order
  std::vector<std::int32_t> tried;    ///< if sites have weights: those that cut or might, appended
  Real blur{};                        ///< how much the sites left out may have shortened an edge
  bool sure = true;                   ///< whether no site was left out that might have an edge that counts
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

  /// Returns a box around a cell that overflowed, smaller than its walls if possible.
  [[nodiscard]] Walls<Real> bounds(Walls<Real> walls) const;

 private:
  using real = Real;  // a word of the shared files
  using Clip = Clipper<Real, Room>;
  using vec2 = typename Clip::vec2;
  using vec4 = typename Clip::vec4;

  struct Subtree {
    std::uint32_t node;
    SiteTree::Range range;
    Real reach;             ///< of its box into the circle or circles in question
    std::uint32_t version;  ///< of the cell at that time
  };

  /// A corner between the lines of two slots; its other data is in arrays, so that loops vectorize.
  struct Corner {
    std::size_t before, after;
    Real turn;   ///< sine of the angle between the lines
    bool known;  ///< no site of the subtree is nearer to it than the cell's own
  };

  /// The site deepest inside the circle around a corner through the cell's own site, among those surely
  /// inside.
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
  double heaviest_anywhere_ = -std::numeric_limits<double>::infinity();  // in or outside the set; not heavy
  Vector<Real> origin_offset_;
  std::size_t corners_ = 0;
  std::size_t corners_end_ = 0;  // end of loops that vectorize; results beyond corners_ are unused
  Corner corner_[Room];
  // By corner: the normal of the line before it; the noise along that line and across it. The corner itself,
  // relative to the site; its squared distance from the site, and the uncertainty of that; the uncertainty of
  // a box's reach.
  Real line_x_[Room], line_y_[Room], noise_[Room], across_[Room];
  Real x_[Room], y_[Room], squared_[Room], widening_[Room], margin_[Room];
  // By slot; valid while line_[k] is still the line in it.
  std::int32_t line_[Room];
  std::int32_t known_after_[Room];  // by slot: the line that ends its edge, if that corner is known
  Real angle_[Room];                // of the normal
  Real moved_[Room], apart_[Room];  // as in RingEdge; apart_ of sites only
  Real new_moved_{}, new_apart_{};  // of the line that cuts
  std::vector<Subtree> beside_;     // the subtrees beside the path from the root to the site's leaf
  std::vector<Subtree> pending_;
  std::vector<std::pair<double, std::uint32_t>> nearest_;  // power of the cell's own site, and rank
  std::uint32_t version_ = 0;
  Real most_margin_{};
  std::vector<std::uint32_t> doubtful_;  // sites that cut the cell once, or might have
  bool surely_empty_ = false;
  Real blur_{};
};

}  // namespace vorpipe::cpu
