/// The sites that may cut a cell where sites have weights, in an order that makes the cell small soon.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "space/site_bins.h"

namespace vorpipe::space {

/// Finds for one cell after another the sites that may cut it, by ascending power at the cell's own site: the
/// squared distance less the weight. Blocks of bins are opened as far as the heaviest site in them could cut
/// from as near as the block is.
class WeightedCandidates {
 public:
  explicit WeightedCandidates(const SiteBins& bins) : bins_(bins) {}
  /// No radius will be larger than that.
  void begin(Label site, double squared_radius);
  /// The next site that may cut off a point within the root of `squared_radius` from the cell's own site; -1
  /// if there is no other. Radii do not grow.
  Label next(double squared_radius);

 private:
  /// A block, or where level is that of sites a site.
  struct Entry {
    double power, squared, lighter;  ///< at least; squared distance; what the own site is heavier by, less
    std::uint32_t index;             ///< of the site, or of the block in its level
    std::uint8_t level;
  };
  static constexpr std::uint8_t site_level = 255;

  static bool isAfter(const Entry& a, const Entry& b);
  void push(const Entry& entry);
  void pushBlock(std::size_t level, const std::array<int, 3>& block, double squared_radius);
  void openBlock(const Entry& entry, double squared_radius);

  const SiteBins& bins_;
  Label site_ = 0;
  Point3 from_{};
  double weight_ = 0;
  std::array<double, 3> at_{};  ///< the site in sides of bins, from the corner of all
  std::vector<Entry> heap_;
};

}  // namespace vorpipe::space
