/// Draws known cells as polygons, split into triangles.
#pragma once

#include "cells/neighbor_rows.h"
#include "picture/canvas.h"

namespace vorpipe::core {

class PolygonDrawing {
 public:
  explicit PolygonDrawing(const Canvas& canvas) : canvas_(canvas) {}

  /// Draws the certified cells of the sites `which` over the present picture; `cells` holds them by index in
  /// the set. Adjacent cells have the same corners, so that there are no gaps. If the device's grid of
  /// vertices is coarse, cells shrink by the distance that corners may move, and leave pixels uncovered.
  /// Errors: the device's; progress said stop.
  Result<void> draw(const View& view, std::span<const std::uint32_t> which, const NeighborRows& cells,
                    const Progress& progress);

  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  struct Triangles;

  Result<void> send(const std::vector<Triangles>& parts);
  Result<void> sendSome(std::span<const DrawMark> corners, std::span<const std::uint32_t> triangles);

  Canvas canvas_;
  double seconds_ = 0;
};

}  // namespace vorpipe::core
