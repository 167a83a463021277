/// Draws cells by the search over the grid on the device.
#pragma once

#include "core/judge/judge.h"
#include "core/search/uploader.h"
#include "core/tiles/tiles.h"

namespace vorpipe::core {

/// Tries each cell fast, then with more room; tile by tile where the sites do not fit the device. Leaves what
/// is left to try once most of a sample fail. Views after the first try at once what the first one came to.
class GridDrawing {
 public:
  GridDrawing(Backend& backend, Upload& upload, const Judge& judge, const SiteSet& sites, int threads,
              const Progress& progress);

  /// Draws the cells of `which`, ascending, into the picture that was begun. Returns those that were not
  /// drawn.
  Result<std::vector<std::uint32_t>> draw(std::span<const std::uint32_t> which);

  [[nodiscard]] std::uint64_t retried() const { return retried_; }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  using Indices = std::vector<std::uint32_t>;

  Result<void> drawTile(const Tile& tile);
  Result<void> drawCells(const Tile& tile, std::span<const std::uint32_t> which);
  void leave(const Tile& tile, std::span<const std::uint32_t> which);
  /// Returns the cells of `which`, indices in the tile, that were not drawn.
  Result<Indices> drawSites(const Indices& which, Effort effort, const char* stage);

  Backend& backend_;
  Upload& upload_;
  const Judge& judge_;
  const SiteSet& sites_;
  int threads_;
  const Progress& progress_;
  std::vector<bool> roomy_;  ///< by site: needs more room than a fast try has
  Indices left_;             ///< in the whole set
  std::size_t cells_ = 0;    ///< of this view
  std::size_t done_ = 0;     ///< those of the tiles before
  std::uint64_t retried_ = 0;
  double seconds_ = 0;
};

}  // namespace vorpipe::core
