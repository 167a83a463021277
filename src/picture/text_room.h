/// Where a text fits into a cell.
#pragma once

#include <cstddef>
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

/// Whether a point lies in the room, and its distance to the nearest ring.
struct Depth {
  bool inside;
  double distance;
};

/// `down`: how much more distances downward count.
Depth depthOf(const Room& room, Point p, double down);

/// Returns the center of a box that fits into the room, as near to a place as possible; none if it does not
/// fit. In a nonconvex room it only tries some places, so it may miss others.
std::optional<Point> placeNear(const Room& room, const TextBox& box, Point near);

/// The same beside a dot with this radius: below, above, right or left of it, whichever is nearest.
std::optional<Point> placeBeside(const Room& room, const TextBox& box, Point dot, double radius);

}  // namespace vorpipe::core
