/// The nearest site of a place, or its nearest image in a periodic domain, in double, for the checks.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "check/run.h"

namespace vorpipe::core::checks {

/// Rounding of a squared distance: two or three differences, squares and sums, for each of two sites, with
/// some margin.
inline constexpr double squared_rounding = 16 * epsilon;

/// A kd-tree that shares no code with the computation of cells and pictures.
class NearestSite {
 public:
  /// Keeps a reference to `run`. `owner` is the claimed owner of each site's position. Sites at the position
  /// of their owner that are no heavier are left out. Otherwise every place near a crowd of equal sites would
  /// be compared with all of them.
  NearestSite(const CheckedSites& run, std::span<const std::uint32_t> owner);
  NearestSite(NearestSite&&) noexcept;
  ~NearestSite();

  /// A site of least distance to p (scaled coordinates), with weights of least power; of equal ones any. For
  /// sites near each other the bisector between them decides.
  [[nodiscard]] std::uint32_t at(Point p) const;

  /// All sites that double cannot distinguish from the nearest, which comes first: their squared distances to
  /// p, or powers, differ from the least by at most rounding.
  [[nodiscard]] std::vector<std::uint32_t> allAt(Point p) const;

  /// A heaviest one of the sites that may be nearest to a place; any site without weights.
  [[nodiscard]] std::uint32_t heaviest() const;

  /// Number of tree nodes visited by long searches so far. Most searches are short; long ones occur if most
  /// sites are about equally far, as from the center of a circle.
  [[nodiscard]] std::uint64_t visited() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// The sites as a periodic domain uses them; nothing if the domain does not repeat. Errors: those of
/// wrapped().
Result<std::optional<Sites>> wrappedIfPeriodic(const Sites& sites, const Box& domain, Periodic periodic,
                                               int threads);

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
