#include "core/tiles/dense_regions.h"

#include <atomic>
#include <iterator>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t rows_at_once = 16;
/// Break-even for a finer grid, in sites in 3 x 3 bins, where 18 are normal ...
constexpr std::uint64_t crowded_bins = 128;
/// ... but not for fewer cells than this ...
constexpr std::size_t least_region = 256;
/// ... unless there are more than this: then the judge, which uses a tree, is faster.
constexpr std::uint64_t hopeless_crowd = 1024;

enum class Density : std::uint8_t { even, crowded, hopeless };

class CrowdSorter {
 public:
  CrowdSorter(const Grid& grid, std::span<const std::uint32_t> which, int threads)
      : grid_(grid), which_(which), threads_(threads) {}

  Crowding run() {
    Crowding crowding;
    if (!findDensities()) {
      crowding.even.reserve(which_.size());
      crowding.even.assign(which_.begin(), which_.end());
      return crowding;
    }
    std::vector<BinBlock> pending{{0, 0, grid_.columns - 1, grid_.rows - 1}};
    while (!pending.empty()) {
      auto block = pending.back();
      pending.pop_back();
      const auto crowded = tighten(block);
      if (crowded.bins == 0) continue;
      if (crowded.sites < least_region) {
        settle(block);
      } else if (2 * crowded.bins >= binsIn(block)) {
        crowding.regions.push_back({block, {}});
      } else {
        const auto [lower, upper] = halves(block);
        pending.push_back(upper);
        pending.push_back(lower);
      }
    }
    takeSites(crowding);
    return crowding;
  }

 private:
  struct Count {
    std::uint64_t bins = 0, sites = 0;
  };

  [[nodiscard]] std::size_t binAt(std::uint32_t column, std::uint32_t row) const {
    return std::size_t{row} * grid_.columns + column;
  }

  /// Returns whether any bin is crowded.
  bool findDensities() {
    density_.resize(std::size_t{grid_.columns} * grid_.rows);
    std::atomic<bool> any{false};
    const int threads = threadsForSteps(density_.size(), threads_);
    parallelFor(grid_.rows, rows_at_once, threads, [&](std::size_t begin, std::size_t end) {
      bool some = false;
      for (auto row = static_cast<std::uint32_t>(begin); row < end; ++row) {
        for (std::uint32_t column = 0; column < grid_.columns; ++column) {
          const auto around = sitesIn(grid_, withMargin(grid_, {column, row, column, row}, 1));
          if (around <= crowded_bins) continue;
          const auto bin = binAt(column, row);
          if (grid_.offsets[bin] == grid_.offsets[bin + 1]) continue;
          density_[bin] = around > hopeless_crowd ? Density::hopeless : Density::crowded;
          some = true;
        }
      }
      if (some) any = true;
    });
    return any;
  }

  template <class Each>
  void forBins(const BinBlock& block, const Each& each) {
    for (auto row = block.south; row <= block.north; ++row) {
      for (auto column = block.west; column <= block.east; ++column) each(column, row, binAt(column, row));
    }
  }

  /// Shrinks a block to its crowded bins, and counts them and the sites in them.
  Count tighten(BinBlock& block) {
    BinBlock tight{block.east, block.north, block.west, block.south};
    Count count;
    forBins(block, [&](std::uint32_t column, std::uint32_t row, std::size_t bin) {
      if (density_[bin] == Density::even) return;
      tight = {std::min(tight.west, column), std::min(tight.south, row), std::max(tight.east, column),
               std::max(tight.north, row)};
      ++count.bins;
      count.sites += grid_.offsets[bin + 1] - grid_.offsets[bin];
    });
    if (count.bins > 0) block = tight;
    return count;
  }

  /// Leaves a small crowd to this grid, as far as that is no worse than the judge.
  void settle(const BinBlock& block) {
    forBins(block, [&](std::uint32_t, std::uint32_t, std::size_t bin) {
      if (density_[bin] == Density::crowded) density_[bin] = Density::even;
    });
  }

  void takeSites(Crowding& crowding) {
    region_.assign(density_.size(), none);
    for (std::uint32_t r = 0; r < crowding.regions.size(); ++r) {
      forBins(crowding.regions[r].block, [&](std::uint32_t, std::uint32_t, std::size_t bin) {
        if (density_[bin] != Density::even) region_[bin] = r;
      });
    }
    std::size_t bin = 0;
    for (const auto site : which_) {
      while (grid_.offsets[bin + 1] <= site) ++bin;
      if (density_[bin] == Density::even) {
        crowding.even.push_back(site);
      } else if (region_[bin] != none) {
        crowding.regions[region_[bin]].own.push_back(site);
      } else {
        crowding.hopeless.push_back(site);
      }
    }
    std::erase_if(crowding.regions, [](const CrowdedRegion& region) { return region.own.empty(); });
  }

  static constexpr std::uint32_t none = ~std::uint32_t{0};

  const Grid& grid_;
  std::span<const std::uint32_t> which_;
  int threads_;
  std::vector<Density> density_;       ///< by bin
  std::vector<std::uint32_t> region_;  ///< by bin
};

}  // namespace

Crowding sortByCrowding(const Grid& grid, std::span<const std::uint32_t> which, int threads) {
  return CrowdSorter(grid, which, threads).run();
}

}  // namespace vorpipe::core
