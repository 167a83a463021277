/// Which cell holds a place.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "vorpipe/cells.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// Finds the sites in whose cells places lie, without the cells. Thread safe.
///
/// A place belongs to the site of least power, with weights, or of least distance: of equal positions to
/// their owner. Along a periodic axis it stands for all of its copies. The sides of the domain belong to it;
/// which places on an outline do is decided as if it lay shifted by an infinitely small way up and to the
/// right.
///
/// Where distances differ by rounding alone the side of the bisector decides, on which a place lies by the
/// differences of coordinates, as in the judge of pictures. A place on the bisector itself has the first of
/// its sites in the input, in a periodic domain of those that are not beyond its border, if any; with weights
/// it may have another of them. It depends on the sites and the domain alone, not on threads or other places.
/// Where three and more sites with weights are equal up to rounding, it may have one without a cell.
class Locator {
 public:
  /// Prepares sites for the domain of `options`, its outline and its period; what else they say does not
  /// matter. `threads`: 0 for all. Errors: as checkInput() (input); out of memory (device).
  static Result<Locator> make(const Sites& sites, const CellsOptions& options, int threads = 0);
  Locator(Locator&&) noexcept;
  Locator& operator=(Locator&&) noexcept;
  ~Locator();

  /// The site, by index in the input, or no_site where the place is beyond the domain or the outline, no
  /// number, or more than 2^50 periods away.
  [[nodiscard]] std::uint32_t at(Point place) const;

  /// The same for many places, on all threads; `sites` is as long as `places`.
  void at(std::span<const Point> places, std::span<std::uint32_t> sites) const;

 private:
  Locator();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe
