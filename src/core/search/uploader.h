/// Which sites a device holds.
#pragma once

#include "core/tiles/tiles.h"

namespace vorpipe::core {

class Upload {
 public:
  /// `palette_index` is by index in the set; empty when nothing will be drawn.
  Upload(Backend& backend, std::span<const std::uint8_t> palette_index)
      : backend_(backend), palette_index_(palette_index) {}

  /// Gives the device a tile's sites. All sites are given once; they stay until a tile replaces them.
  Result<void> give(const Tile& tile);

  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  Backend& backend_;
  std::span<const std::uint8_t> palette_index_;
  std::vector<std::uint8_t> tile_palette_index_;
  bool has_all_ = false;
  double seconds_ = 0;
};

}  // namespace vorpipe::core
