#include "core/search/uploader.h"

#include "base/stopwatch.h"

namespace vorpipe::core {

Result<void> Upload::give(const Tile& tile) {
  const bool all = tile.whole.empty();
  if (all && has_all_) return {};
  const Stopwatch watch;
  if (!all && !shade_.empty()) {
    tile_shade_.clear();
    for (const auto site : tile.whole) tile_shade_.push_back(shade_[site]);
  }
  if (auto uploaded = backend_.upload(tile.sites, all ? shade_ : std::span(tile_shade_)); !uploaded) {
    return uploaded;
  }
  has_all_ = all;
  seconds_ += watch.seconds();
  return {};
}

}  // namespace vorpipe::core
