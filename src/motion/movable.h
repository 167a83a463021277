/// Sites that move: checks of the input, and where sites may move to.
#pragma once

#include <algorithm>
#include <memory>

#include "vorpipe.h"

namespace vorpipe::moving {

/// Returns the options of cells that sites have while they move.
template <class Options>
CellsOptions cellsOf(const Options& options) {
  CellsOptions cells{};
  cells.domain = options.domain;
  cells.periodic = options.periodic;
  cells.search = options.search;
  cells.progress = options.progress;
  if constexpr (requires { options.outline; }) {
    cells.outline = options.outline;
  }
  if constexpr (requires { options.density; }) {
    cells.density = options.density;
  }
  return cells;
}

/// Makes the checks of checkInput(), and more. Energies are masses times squared lengths, and squares of
/// energies are summed. So sides of the domain are 1e-40 to 1e40, and the largest density is 1e-30 to 1e30.
/// Errors (input).
Result<void> checkMovable(const Sites& sites, const CellsOptions& options, int threads);

/// Refuses (input) a density whose largest value is not 1e-30 to 1e30.
Result<void> checkRange(const Density& density);

/// Which axes repeat.
struct RepeatingAxes {
  bool x, y;
};
RepeatingAxes repeats(Periodic periodic);

/// Refuses (input) two sites at one place, since neither can have a mass of its own. Both ends of a period
/// are one place; sites are inside of it.
Result<void> checkPlaces(const Sites& sites, const Box& domain, Periodic periodic);

/// Refuses (input) an invalid tolerance: less than 0, or not a number.
Result<void> checkTolerance(double tolerance);

/// Maps a place outside a box or an outline to the nearest place inside. That is the best target for a site
/// whose centroid lies outside: it has the least energy of all places in the domain, since energy grows with
/// the squared distance to the centroid. Along periodic axes all places are allowed.
class AllowedPlaces {
 public:
  /// The domain is valid.
  AllowedPlaces(const Box& domain, const Outline& outline, Periodic periodic);
  ~AllowedPlaces();

  [[nodiscard]] bool contain(Point place) const;
  /// Returns the place itself, or the nearest allowed one.
  [[nodiscard]] Point nearestTo(Point place) const { return shape_ ? nearestInShape(place) : inBox(place); }

 private:
  struct Shape;
  [[nodiscard]] Point inBox(Point place) const {
    if (!repeats_.x) place.x = std::clamp(place.x, domain_.xmin, domain_.xmax);
    if (!repeats_.y) place.y = std::clamp(place.y, domain_.ymin, domain_.ymax);
    return place;
  }
  [[nodiscard]] Point nearestInShape(Point place) const;

  Box domain_;
  RepeatingAxes repeats_;
  std::unique_ptr<Shape> shape_;  ///< of an outline
};

}  // namespace vorpipe::moving
