#include "space/exact_search.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace vorpipe::space {
namespace {

/// Sites by ascending distance from one of them: the bins around it in shells of cubes.
class Outward {
 public:
  Outward(const SiteBins& bins, Label site)
      : bins_(bins), site_(site), from_(bins.sites[static_cast<std::size_t>(site)]) {
    const auto bin = bins.binOf(from_);
    for (std::size_t a = 0; a < 3; ++a) {
      bin_[a] = bin[a];
      last_shell_ = std::max({last_shell_, bin[a], bins.count[a] - 1 - bin[a]});
    }
  }

  /// The next site whose squared distance is at most `limit`, or -1. Limits do not grow.
  Label next(double limit) {
    while (heap_.empty() || heap_.front().first > certain_) {
      if (certain_ > limit || shell_ > last_shell_) break;
      addShell();
    }
    if (heap_.empty() || heap_.front().first > limit) return -1;
    std::ranges::pop_heap(heap_, std::greater<>());
    const Label site = heap_.back().second;
    heap_.pop_back();
    return site;
  }

 private:
  void addShell() {
    const int r = shell_++;
    for (int z = std::max(0, bin_[2] - r); z <= std::min(bins_.count[2] - 1, bin_[2] + r); ++z) {
      for (int y = std::max(0, bin_[1] - r); y <= std::min(bins_.count[1] - 1, bin_[1] + r); ++y) {
        const bool whole_line = std::abs(z - bin_[2]) == r || std::abs(y - bin_[1]) == r;
        for (int x = bin_[0] - r; x <= bin_[0] + r; x += whole_line || r == 0 ? 1 : 2 * r) {
          if (x >= 0 && x < bins_.count[0]) addBin(x, y, z);
        }
      }
    }
    // A site of a farther shell is at least that many whole bins away; less what rounding takes.
    const double least = static_cast<double>(r) * bins_.side * (1 - 1e-9);
    certain_ = shell_ > last_shell_ ? std::numeric_limits<double>::infinity() : least * least;
  }

  void addBin(int x, int y, int z) {
    const std::size_t bin = (static_cast<std::size_t>(z) * static_cast<std::size_t>(bins_.count[1]) +
                             static_cast<std::size_t>(y)) *
                                static_cast<std::size_t>(bins_.count[0]) +
                            static_cast<std::size_t>(x);
    for (std::uint32_t j = bins_.begin[bin]; j < bins_.begin[bin + 1]; ++j) {
      if (static_cast<Label>(j) == site_) continue;
      const Point3& p = bins_.sites[j];
      const double dx = p.x - from_.x, dy = p.y - from_.y, dz = p.z - from_.z;
      heap_.emplace_back(dx * dx + dy * dy + dz * dz, static_cast<Label>(j));
      std::ranges::push_heap(heap_, std::greater<>());
    }
  }

  const SiteBins& bins_;
  Label site_;
  Point3 from_;
  int bin_[3] = {}, shell_ = 0, last_shell_ = 0;
  double certain_ = 0;  ///< no site that is not in the heap is nearer than the root of this
  std::vector<std::pair<double, Label>> heap_;
};

}  // namespace

ExactCell exactCellOf(const SiteBins& bins, Label site) {
  ExactCell cell(bins.places(), site);
  Outward outward(bins, site);
  constexpr double slack = 1 + 1e-9;  // of squared distances and radii that are rounded
  for (;;) {
    if (cell.empty()) break;
    const Label by = outward.next(4 * slack * cell.squaredRadius());
    if (by < 0) break;
    cell.cut(by);
  }
  return cell;
}

}  // namespace vorpipe::space
