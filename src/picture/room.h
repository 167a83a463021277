/// Where a text finds room in a cell.
#pragma once

#include <optional>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// What shows of a cell, in pixels, y downward: where its rings, by the rule of even and odd, and `shown`
/// are.
struct Room {
  std::vector<Point> points;
  std::vector<std::size_t> offsets;  ///< where each ring begins in `points`, and where the last ends
  Box shown;
};

/// What has to fit.
struct TextBox {
  double width, height;
  double gap;  ///< to the rings
};

/// The middle of a box that fits into the room, as near to a place as may be; none where it does not fit. In
/// a room that is not convex some places are tried, and there may be others.
std::optional<Point> placeNear(const Room& room, const TextBox& box, Point near);

/// The same beside a dot with this radius: below, above, right or left of it, whatever is nearest.
std::optional<Point> placeBeside(const Room& room, const TextBox& box, Point dot, double radius);

}  // namespace vorpipe::core
