/// Draws cells that are known: their polygons, as triangles.
#pragma once

#include "cells/neighbor_rows.h"
#include "picture/canvas.h"

namespace vorpipe::core {

class PolygonDrawing {
 public:
  explicit PolygonDrawing(const Canvas& canvas) : canvas_(canvas) {}

  /// Draws those cells of the sites `which` that are certified over what is there; `cells` has them by index
  /// in the set. Cells that meet have the same corners, so that they leave no gap. Where the device's grid of
  /// vertices is coarse, they are smaller by what corners may move, and leave pixels. Errors: the device's;
  /// progress said stop.
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
