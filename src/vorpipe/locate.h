/// Point location: which cell contains a place.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "vorpipe/cells.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// Finds the sites whose cells contain given places, without computing the cells. Thread safe.
///
/// A place belongs to the site of least distance, or of least power with weights; of equal positions, to
/// their owner. Along a periodic axis a place stands for all of its copies. The sides of the domain belong to
/// it. Whether a place on an outline belongs is decided as if the place were shifted infinitesimally up and
/// to the right.
///
/// If distances differ only by rounding, the side of the bisector decides. It is computed from differences of
/// coordinates, as when pictures are judged. A place on the bisector itself gets the first of its sites in
/// the input; in a periodic domain, the first of those not beyond its border, if any. With weights it may get
/// another of these sites. The result depends only on the sites and the domain, not on threads or other
/// places. Where three or more weighted sites are equal up to rounding, the result may be a site without a
/// cell.
///
/// On the globe places are degrees, of longitudes of any turn, and one as near to several sites, up to
/// rounding, belongs to the first of them. Sides of an outline belong to it.
class Locator {
 public:
  /// Prepares sites for the domain of `options`, its outline and its period; other options are ignored.
  /// `threads`: 0 for all. Errors: those of checkInput() (input); out of memory (device).
  static Result<Locator> make(const Sites& sites, const CellsOptions& options, int threads = 0);
  Locator(Locator&&) noexcept;
  Locator& operator=(Locator&&) noexcept;
  ~Locator();

  /// The site, by index in the input; no_site if the place is beyond the domain or the outline, is NaN, or is
  /// more than 2^50 periods away.
  [[nodiscard]] std::uint32_t at(Point place) const;

  /// The same for many places, on all threads; `sites` is as long as `places`.
  void at(std::span<const Point> places, std::span<std::uint32_t> sites) const;

 private:
  Locator();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe
