/// Which sites a device holds.
#pragma once

#include <optional>

#include "sites/tiles.h"

namespace vorpipe::core {

/// Whether a device still holds all sites of a set, with their colors, from one run to the next.
struct HeldSites {
  /// Number of uploads to the device in use, by this or by others; null if unknown.
  const std::uint64_t* uploads = nullptr;
  std::optional<std::uint64_t> after{};  ///< that number just after these sites were uploaded

  [[nodiscard]] bool areThere() const { return uploads != nullptr && after == *uploads; }
};

class Upload {
 public:
  /// `palette_index` is by index in the set; empty when nothing will be drawn. `held` outlives this; without
  /// it, the device counts as holding nothing before and afterwards.
  Upload(Backend& backend, std::span<const std::uint8_t> palette_index, HeldSites* held = nullptr)
      : backend_(backend), palette_index_(palette_index), held_(held) {}

  /// Gives the device a tile's sites. All sites are given once; they stay until a tile replaces them.
  Result<void> give(const Tile& tile);

  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  Backend& backend_;
  std::span<const std::uint8_t> palette_index_;
  HeldSites* held_;
  std::vector<std::uint8_t> tile_palette_index_;
  bool has_all_ = false;
  double seconds_ = 0;
};

}  // namespace vorpipe::core
