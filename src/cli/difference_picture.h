/// Pictures that show where two images differ.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::cli {

/// RGBA pixels without ids, row 0 on top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> rgba;
};

/// Dark gray, one shade for each id, black where there is none.
Picture grayOfIds(std::span<const std::uint32_t> ids, int width, int height);

/// The brightness of a picture, dimmed.
Picture grayOfColors(std::span<const std::uint32_t> rgba, int width, int height);

/// Paints wrong pixels red and ties yellow; in large pictures as squares, so that a single one is seen.
/// A wrong pixel is never covered by a tie.
void markDifferences(Picture& picture, std::span<const PixelMatch> pixels);

/// Copies `from` into `to` with its top left corner at (row, column), where it must fit.
void paste(Picture& to, const Picture& from, int row, int column);

}  // namespace vorpipe::cli
