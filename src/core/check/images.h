/// Images of sites in a periodic domain, as the checks see them.
#pragma once

#include <optional>
#include <vector>

#include "core/check/nearest_site.h"
#include "core/check/run.h"

namespace vorpipe::checks {

/// The sites of a run as its domain takes them: the caller's, but in a periodic domain.
struct InsideSites {
  std::optional<Sites> wrapped;
  [[nodiscard]] const Sites& of(const Sites& callers) const { return wrapped ? *wrapped : callers; }
};

/// Errors: those of wrapped().
Result<InsideSites> insideOf(const Sites& sites, const Box& domain, Periodic periodic, int threads);

/// Where sites stand, the same for those that the period makes equal.
class SitePlaces {
 public:
  explicit SitePlaces(const CheckedSites& run);
  [[nodiscard]] Point at(std::size_t i) const;

 private:
  const CheckedSites& run_;
  Point low_{}, high_{};  ///< where sites in the domain's corners stand
};

/// An image of a site.
struct NearImage {
  std::uint32_t site;
  Point place;
};

/// A site or image of least distance to p, or with weights of least power.
NearImage nearestImage(const CheckedSites& run, const NearestSite& nearest, Point p);

/// All sites and images that double does not tell from the nearest, that first.
std::vector<NearImage> nearestImages(const CheckedSites& run, const NearestSite& nearest, Point p);

/// The place of the site or image of i of least distance to p.
Point imageNear(const CheckedSites& run, std::size_t i, Point p);

}  // namespace vorpipe::checks
