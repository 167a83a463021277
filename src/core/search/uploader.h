/// Which sites a device holds.
#pragma once

#include "core/tiles/tiles.h"

namespace vorpipe::core {

class Upload {
 public:
  /// `shade` is by index in the set; empty when nothing will be drawn.
  Upload(Backend& backend, std::span<const std::uint8_t> shade) : backend_(backend), shade_(shade) {}

  /// Gives the device a tile's sites. All sites are given once; they stay until a tile replaces them.
  Result<void> give(const Tile& tile);

  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  Backend& backend_;
  std::span<const std::uint8_t> shade_;
  std::vector<std::uint8_t> tile_shade_;
  bool has_all_ = false;
  double seconds_ = 0;
};

}  // namespace vorpipe::core
