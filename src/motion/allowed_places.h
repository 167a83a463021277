/// Where sites may move to: the domain.
#pragma once

#include <algorithm>
#include <memory>

#include "vorpipe.h"

namespace vorpipe::moving {

/// Maps a place outside a box or an outline to the nearest place inside. That is the best target for a site
/// whose centroid lies outside: it has the least energy of all places in the domain, since energy grows with
/// the squared distance to the centroid. Along periodic axes all places are allowed.
class AllowedPlaces {
 public:
  /// The domain is valid.
  AllowedPlaces(const Box& domain, const Outline& outline, Periodic periodic);
  AllowedPlaces(AllowedPlaces&&) noexcept;
  AllowedPlaces& operator=(AllowedPlaces&&) noexcept;
  ~AllowedPlaces();

  [[nodiscard]] bool contain(Point place) const;
  /// Returns the place itself, or the nearest allowed one.
  [[nodiscard]] Point nearestTo(Point place) const { return shape_ ? nearestInShape(place) : inBox(place); }

 private:
  struct Shape;
  [[nodiscard]] Point inBox(Point place) const {
    if (!x_repeats_) place.x = std::clamp(place.x, domain_.xmin, domain_.xmax);
    if (!y_repeats_) place.y = std::clamp(place.y, domain_.ymin, domain_.ymax);
    return place;
  }
  [[nodiscard]] Point nearestInShape(Point place) const;

  Box domain_;
  bool x_repeats_, y_repeats_;
  std::unique_ptr<Shape> shape_;  ///< of an outline
};

}  // namespace vorpipe::moving
