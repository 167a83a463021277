/// Finds room for a text in a cell.
#pragma once

#include <optional>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// The visible part of a cell, in pixels, y downward: the intersection of its rings, by the even-odd rule,
/// and `shown`.
struct Room {
  std::vector<Point> points;
  std::vector<std::size_t> offsets;  ///< start of each ring in `points`, then the end of the last
  Box shown;
};

/// The box to fit.
struct TextBox {
  double width, height;
  double gap;  ///< to the rings
};

/// Returns the center of a box that fits into the room, as near to a place as possible; none if it does not
/// fit. In a nonconvex room it only tries some places, so it may miss others.
std::optional<Point> placeNear(const Room& room, const TextBox& box, Point near);

/// The same beside a dot with this radius: below, above, right or left of it, whichever is nearest.
std::optional<Point> placeBeside(const Room& room, const TextBox& box, Point dot, double radius);

}  // namespace vorpipe::core
