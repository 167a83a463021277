#include "cells/uploader.h"

#include "base/stopwatch.h"
#include "base/try.h"

namespace vorpipe::core {

Result<void> Upload::give(const Tile& tile) {
  const bool all = tile.whole.empty();
  if (all && (has_all_ || (held_ != nullptr && held_->areThere()))) return {};
  const Stopwatch watch;
  if (!all && !palette_index_.empty()) {
    tile_palette_index_.clear();
    for (const auto site : tile.whole) tile_palette_index_.push_back(palette_index_[site]);
  }
  VORPIPE_TRY(backend_.upload(tile.sites, all ? palette_index_ : std::span(tile_palette_index_)));
  has_all_ = all;
  if (held_ != nullptr) {
    held_->after.reset();
    if (all && held_->uploads != nullptr) held_->after = *held_->uploads;
  }
  seconds_ += watch.seconds();
  return {};
}

}  // namespace vorpipe::core
