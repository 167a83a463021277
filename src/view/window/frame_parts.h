/// The parts of a frame, for both presenters: a copy of the picture, or triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "view/window/presenter.h"

namespace vorpipe::view {

bool hasPicture(const Shown& frame);

/// Whether the picture fills the window pixel by pixel, so that it can be copied.
bool isSharp(const Shown& frame, int width, int height);

/// Blends the picture's pixels over `background`, opaque, into `to` of the same size.
void putOverBackground(const Image& picture, std::span<std::uint32_t> to);

/// The texture of triangles.
enum class Surface : std::uint8_t { picture, panel };

/// Some of the triangles, clipped to a rectangle inside the window.
struct TrianglePart {
  Surface surface = Surface::picture;
  std::uint32_t first_index = 0, indices = 0;
  std::int32_t left = 0, top = 0, width = 0, height = 0;
};

struct FrameTriangles {
  std::vector<PanelVertex>
      vertices;  ///< x, y in normalized device coordinates, -1 at the left and at the top
  std::vector<std::uint32_t> indices;
  std::vector<TrianglePart> parts;  ///< in drawing order
};

/// Returns triangles of the picture, unless it is sharp, and of the panel, in a window of `width` x `height`
/// pixels.
FrameTriangles trianglesOf(const Shown& frame, int width, int height);

}  // namespace vorpipe::view
