/// The exact search of pictures and places: finds the nearest site in double.
#pragma once

#include <memory>

#include "backend/backend.h"

namespace vorpipe::cpu {

/// Returns the origin from which sites and places are measured: along each axis the domain's corner if
/// differences to it are exact, for sites in the domain and beside it; else 0.
Point countedFrom(const Box& domain);

/// Finds nearest sites. Independent of the clipping: a kd-tree over the sites.
class NearestSite {
 public:
  NearestSite(const SiteSet& sites, int threads);  ///< `sites` must outlive this
  ~NearestSite();

  /// Returns the index in the set of the site nearest by power to place `p`, given relative to `from`, in
  /// scaled units, or no_site if all are hidden. If squared distances differ only by rounding, the place's
  /// side of the sites' bisector decides; on the bisector, the first site of the input wins. If `from` is a
  /// corner of the domain, a place in the domain is rounded no more than its distance to that corner is.
  [[nodiscard]] std::uint32_t at(Point from, Point p) const;

  class Walk;

 private:
  struct Tree;
  [[nodiscard]] Point placeOf(Point from, Point p) const;
  /// Sets `reach`, unless null, to the radius around the place within which the same site must be nearest.
  [[nodiscard]] std::uint32_t find(Point place, double* reach) const;

  std::unique_ptr<Tree> tree_;
};

/// The same for consecutive places, each some `step` from the previous one. Skips the search where the same
/// site must be nearest.
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
  /// Number of places still to find without computing the reach: the last one was less than a step, and
  /// computing it takes longer.
  int in_vain_ = 0;
};

}  // namespace vorpipe::cpu
