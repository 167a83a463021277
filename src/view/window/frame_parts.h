/// What a frame consists of, for either presenter: a copy of the picture, or triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "view/window/presenter.h"

namespace vorpipe::view {

/// Whether there is a picture to show.
bool hasPicture(const Shown& frame);

/// Whether the picture fills the window, pixel on pixel, so that it is copied.
bool isSharp(const Shown& frame, int width, int height);

/// The picture's pixels over `background`, opaque, to as many places.
void putOverBackground(const Image& picture, std::span<std::uint32_t> to);

/// What triangles are covered with.
enum class Surface : std::uint8_t { picture, panel };

/// Some of the triangles, cut off outside of a rectangle that lies in the window.
struct TrianglePart {
  Surface surface = Surface::picture;
  std::uint32_t first_index = 0, indices = 0;
  std::int32_t left = 0, top = 0, width = 0, height = 0;
};

struct FrameTriangles {
  std::vector<PanelVertex>
      vertices;  ///< x, y in normalized device coordinates, -1 at the left and at the top
  std::vector<std::uint32_t> indices;
  std::vector<TrianglePart> parts;  ///< in the order in which they are drawn
};

/// The picture, unless it is sharp, and the panel, in a window of `width` x `height` pixels.
FrameTriangles trianglesOf(const Shown& frame, int width, int height);

}  // namespace vorpipe::view
