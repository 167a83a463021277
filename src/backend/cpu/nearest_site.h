/// The judge of pictures and of places: which site is nearest, in double.
#pragma once

#include <memory>

#include "backend/backend.h"

namespace vorpipe::cpu {

/// Where sites and places are counted from: the domain's corner, along an axis where no difference to it is
/// rounded, of sites in the domain and beside it.
Point countedFrom(const Box& domain);

/// Finds nearest sites. Independent of the clipping: a kd-tree over the sites.
class NearestSite {
 public:
  NearestSite(const SiteSet& sites, int threads);  ///< `sites` must outlive this
  ~NearestSite();

  /// The index in the set of the site nearest to a place, seen from another, in scaled units, by power, or
  /// no_site where all are hidden. Sites whose squared distances differ by rounding alone are told apart by
  /// the place's side of their bisector; of those with the place on it the first of the input is taken. From
  /// a corner of the domain no place in it is rounded by more than its distance to that.
  [[nodiscard]] std::uint32_t at(Point from, Point p) const;

  class Walk;

 private:
  struct Tree;
  [[nodiscard]] Point placeOf(Point from, Point p) const;
  /// `reach`, if it is not null, is set to how far around the place the same site must be nearest.
  [[nodiscard]] std::uint32_t find(Point place, double* reach) const;

  std::unique_ptr<Tree> tree_;
};

/// The same for places that come one after the other, each some `step` from the one before: where the same
/// site must be nearest, nothing is searched for.
class NearestSite::Walk {
 public:
  Walk(const NearestSite& nearest, double step) : nearest_(nearest), step_(step) {}
  [[nodiscard]] std::uint32_t at(Point from, Point p);

 private:
  const NearestSite& nearest_;
  double step_;
  Point searched_{};
  double reach_ = 0;  ///< within it of `searched_`, `site_` is nearest
  std::uint32_t site_ = no_site;
  /// Places that are still found without asking how far: the last answer was less than a step, and to ask
  /// takes longer.
  int in_vain_ = 0;
};

}  // namespace vorpipe::cpu
