/// Differences of two images: as pictures, in words and as JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::cli {

/// RGBA pixels without ids, row 0 on top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> rgba;
};

/// Returns dark gray pixels, one shade for each id, black where there is no id.
Picture grayOfIds(std::span<const std::uint32_t> ids, int width, int height);

/// Returns the dimmed brightness of a picture.
Picture grayOfColors(std::span<const std::uint32_t> rgba, int width, int height);

/// Paints wrong pixels red, and ties and close ones yellow; in large pictures as squares, so that single ones
/// are visible. A tie never covers a wrong pixel.
void markDifferences(Picture& picture, std::span<const PixelMatch> pixels);

/// Copies `from` into `to` with its top left corner at (row, column), where it must fit.
void paste(Picture& to, const Picture& from, int row, int column);

/// Error (input): an id of `image`, which was read from `path`, is not the index of one of `sites`: ties
/// could not be told from errors.
Result<void> checkIds(const std::string& path, const Image& image, const Sites& sites);

/// Describes a place: "row 3, column 4: sites 7 and 9, 1.25 px from their bisector".
std::string placeText(const IdDifference& place);

/// Describes a disagreement in one line: the count and the first place.
std::string disagreementText(const IdDiff& diff);

/// What was found, with the first places that differ.
nlohmann::ordered_json diffJson(const IdDiff& diff);
nlohmann::ordered_json diffJson(const ImageDiff& diff);

}  // namespace vorpipe::cli
