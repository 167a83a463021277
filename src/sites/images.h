/// A periodic domain, along one axis or both: the positions of its sites, their images, and how far beyond
/// the domain these are needed.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// One axis of a domain, in scaled units. Where it is periodic, coordinates and the period are multiples of a
/// quantum, so that images are exact copies: results computed from two copies are equal.
class PeriodicAxis {
 public:
  /// The axis of a domain from low_end to high_end; without a period, coordinates are the scaled numbers.
  PeriodicAxis(double low_end, double high_end, bool repeats);

  struct Placed {
    double place;    ///< in [low, high) where the axis is periodic
    double periods;  ///< from there to the site; 2^51 if the site is more than 2^50 periods away
  };
  [[nodiscard]] Placed put(double scaled) const;
  /// Whether a scaled number lies in the domain, both ends included.
  [[nodiscard]] bool contains(double scaled) const { return scaled >= low_ && scaled <= high_; }
  /// The scaled number of a coordinate moved by a whole number of periods; exact where it lies in the
  /// domain.
  [[nodiscard]] double number(double place, double periods) const {
    return (place + periods * length) + offset_;
  }

  bool periodic;
  double low, high;  ///< of the domain, in coordinates of this axis
  double length;     ///< the period

 private:
  double low_, high_, offset_ = 0, quantum_ = 0;
};

/// An image of a site: shift[0] widths and shift[1] heights of the domain away from it.
struct SiteImage {
  std::uint32_t site;
  std::array<std::int8_t, 2> shift;
};

/// The sites of a periodic domain. Axis 0 is x, axis 1 is y.
struct PeriodicSites {
  std::array<PeriodicAxis, 2> axis;
  int exponent;  ///< scaled units are the input's times 2^exponent
  Sites sites;   ///< each in the domain along the axes that are periodic; weights scaled
  /// By site: number of periods, 0 or 1, from its position in `sites` to where its cell is reported. A site
  /// at the domain's upper end is computed at the lower end, but reported where it is.
  std::vector<std::array<std::int8_t, 2>> home;
  bool all_inside = true;  ///< no site lies outside of the domain along an axis that is not periodic

  [[nodiscard]] Box domain() const { return {axis[0].low, axis[1].low, axis[0].high, axis[1].high}; }
};

/// Puts the sites into the domain. Errors (input): those of checkSites; a site more than 2^50 periods away.
Result<PeriodicSites> placeSites(const Sites& sites, const Box& domain, Periodic periodic, int threads);

/// How far beyond the domain images are needed, along each axis; a whole period is always enough.
struct Band {
  std::array<double, 2> width{0, 0};
  /// The heaviest sites, ascending, all of whose images within a period are included. Otherwise every cell
  /// near the domain's border would need a band as wide as the reach of these sites.
  std::vector<std::uint32_t> heavy;
  double heaviest = 0;  ///< largest weight of the others
};

/// Sites and images in one list: entries 0 to count - 1 are the sites, the others their images.
struct SiteImages {
  std::size_t count = 0;
  std::vector<SiteImage> images;

  /// The site that entry i is or is an image of.
  [[nodiscard]] std::uint32_t siteOf(std::uint32_t i) const { return i < count ? i : images[i - count].site; }
};

/// Sites together with their images in the domain and a band around it, and all images of heavy sites.
struct ImagedSites : SiteImages {
  Sites sites;    ///< of the entries
  Box covered{};  ///< holds images of all sites
  Box box{};  ///< clip box of cells: as `covered`, or a whole period on each side if heavy sites have images
};

/// Calls `take` for each image in the band, and for all images of heavy sites.
void eachImage(const PeriodicSites& placed, const Band& band,
               const std::function<void(const SiteImage&)>& take);

ImagedSites withImages(const PeriodicSites& placed, const Band& band);

/// Returns a band wide enough for a picture of the domain: for every point of the domain, no image beyond the
/// band is nearer than the nearest site or image within.
Band bandForPlaces(const PeriodicSites& placed, int threads);

/// Returns a band likely to be wide enough for whole cells, which reach beyond the domain.
Band likelyBandForCells(const PeriodicSites& placed, int threads);

/// Returns `width`, or, if it is not much less than a whole period, that period, which is always enough.
double cappedBand(const PeriodicAxis& axis, double width);

/// Whether the band along an axis is a whole period, which is always enough.
inline bool isWhole(const Band& band, const PeriodicSites& placed, std::size_t a) {
  return !placed.axis[a].periodic || band.width[a] >= placed.axis[a].length;
}

/// The sites that a diagram or a picture of a domain is made from, whether it is periodic or not.
struct Scene {
  ImagedSites imaged;  ///< `sites` is empty if the domain is not periodic: the caller's sites are then used
  Box clip{};          ///< what cells are clipped to
  Box picture{};       ///< the domain, in the same units

  [[nodiscard]] const Sites& sitesOr(const Sites& callers) const {
    return imaged.sites.size() == 0 ? callers : imaged.sites;
  }
  /// The caller's site that entry i is, or is an image of.
  [[nodiscard]] std::uint32_t siteOf(std::uint32_t i) const { return imaged.siteOf(i); }
};

/// The scene of a picture without cells. Errors: as placeSites'.
Result<Scene> sceneOf(const Sites& sites, const RenderOptions& options, int threads);

/// The scene of a domain that is not periodic.
Scene plainScene(const Sites& sites, const Box& domain);

/// Maps ids of images to their sites.
void nameSites(const Scene& scene, std::span<std::uint32_t> ids);

}  // namespace vorpipe::core
