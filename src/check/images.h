/// Images of sites in a periodic domain, for the checks.
#pragma once

#include <optional>
#include <vector>

#include "check/nearest_site.h"
#include "check/run.h"

namespace vorpipe::core::checks {

/// The sites of a run as its domain uses them: the caller's, or in a periodic domain the wrapped ones.
struct InsideSites {
  std::optional<Sites> wrapped;
  [[nodiscard]] const Sites& of(const Sites& callers) const { return wrapped ? *wrapped : callers; }
};

/// Errors: those of wrapped().
Result<InsideSites> insideOf(const Sites& sites, const Box& domain, Periodic periodic, int threads);

/// Positions of sites, equal for sites that the period makes equal.
class SitePlaces {
 public:
  explicit SitePlaces(const CheckedSites& run) : run_(run) {}
  [[nodiscard]] Point at(std::size_t i) const;

 private:
  const CheckedSites& run_;
};

/// An image of `site`, at `place`, offset from it by `shift` periods.
struct NearImage {
  std::uint32_t site;
  Shift shift;
  Point place;
};

/// A site or image of least distance to p; with weights, of least power.
NearImage nearestImage(const CheckedSites& run, const NearestSite& nearest, Point p);

/// All sites and images that double cannot distinguish from the nearest; the nearest comes first.
std::vector<NearImage> nearestImages(const CheckedSites& run, const NearestSite& nearest, Point p);

/// The vector from one image to another.
inline Point wayTo(const CheckedSites& run, const NearImage& from, const NearImage& to) {
  return run.way(from.site, to.site, {to.shift[0] - from.shift[0], to.shift[1] - from.shift[1]});
}

/// The copy of site i of least distance to p.
NearImage imageNear(const CheckedSites& run, std::uint32_t i, Point p);

}  // namespace vorpipe::core::checks
