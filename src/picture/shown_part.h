/// The visible part of a picture, in the units of its cells.
#pragma once

#include "sites/scene.h"

namespace vorpipe::core {

/// Pixels that show a part of a box, counted from the left and from the bottom.
struct ShownPart {
  Box box{};               ///< everything that the frame shows
  int across = 0, up = 0;  ///< its pixels
  int left = 0, bottom = 0, width = 0, height = 0;

  /// Returns the box that some of the part's pixels show, relative to the box's lower left corner.
  [[nodiscard]] Box boxOf(int column, int row, int columns, int rows) const {
    const auto x = [&](int at) { return (box.xmax - box.xmin) * (left + at) / across; };
    const auto y = [&](int at) { return (box.ymax - box.ymin) * (bottom + at) / up; };
    return {x(column), y(row), x(column + columns), y(row + rows)};
  }
};

/// Returns the box that a picture shows, in the units of its scene.
Box shownIn(const Scene& scene, const RenderOptions& options);

/// Returns the pixels of a picture that show its domain. The sites are the scene's times 2^exponent.
ShownPart shownPart(const Scene& scene, const RenderOptions& options, int exponent);

}  // namespace vorpipe::core
