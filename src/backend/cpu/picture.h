/// The judge of every picture: which site is nearest to a pixel's center, in double.
#pragma once

#include <memory>

#include "backend/backend.h"

namespace vorpipe::cpu {

/// Finds nearest sites. Independent of the clipping: a kd-tree over the sites.
class NearestSite {
 public:
  explicit NearestSite(const SiteSet& sites);  ///< `sites` must outlive this
  ~NearestSite();

  /// The index in the set of the site nearest to (x, y), scaled units, by power. Sites whose squared
  /// distances differ by rounding alone are told apart by the sign of the point's side of their bisector.
  [[nodiscard]] std::uint32_t at(double x, double y) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// Writes the index in the set of the nearest site for every pixel center of the view; row 0 is
/// the bottom.
void nearestSites(const NearestSite& nearest, const View& view, int threads, std::span<std::uint32_t> out);

}  // namespace vorpipe::cpu
