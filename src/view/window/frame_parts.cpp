#include "view/window/frame_parts.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace vorpipe::view {
namespace {

std::uint32_t channelOver(std::uint32_t color, std::uint32_t under, std::uint32_t alpha, int shift) {
  const std::uint32_t over = (color >> shift) & 0xFFU, below = (under >> shift) & 0xFFU;
  return (over * alpha + below * (255U - alpha) + 127U) / 255U << shift;
}

std::uint32_t overBackground(std::uint32_t color) {
  const std::uint32_t alpha = color >> 24;
  if (alpha == 255U) return color;
  if (alpha == 0U) return background;
  return 0xFF000000U | channelOver(color, background, alpha, 0) | channelOver(color, background, alpha, 8) |
         channelOver(color, background, alpha, 16);
}

void addPicture(const Placement& at, int width, int height, FrameTriangles& triangles) {
  constexpr std::uint32_t white = 0xFFFFFFFFU;
  constexpr std::array<std::array<int, 2>, 4> corners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  constexpr std::array<std::uint32_t, 6> indices = {0, 1, 2, 0, 2, 3};
  for (const auto& [u, v] : corners) {
    triangles.vertices.push_back({static_cast<float>(at.left + u * at.width),
                                  static_cast<float>(at.top + v * at.height), static_cast<float>(u),
                                  static_cast<float>(v), white});
  }
  triangles.indices.assign(indices.begin(), indices.end());
  triangles.parts.push_back(
      {Surface::picture, 0, static_cast<std::uint32_t>(indices.size()), 0, 0, width, height});
}

void addPanel(const PanelTriangles& panel, int width, int height, FrameTriangles& triangles) {
  const auto first_vertex = static_cast<std::uint32_t>(triangles.vertices.size());
  const auto first_index = static_cast<std::uint32_t>(triangles.indices.size());
  triangles.vertices.insert(triangles.vertices.end(), panel.vertices.begin(), panel.vertices.end());
  for (const std::uint32_t index : panel.indices) triangles.indices.push_back(first_vertex + index);
  for (const PanelPart& part : panel.parts) {
    assert(std::size_t{part.first_index} + part.indices <= panel.indices.size());
    const int left = std::clamp(part.left, 0, width), right = std::clamp(part.right, 0, width);
    const int top = std::clamp(part.top, 0, height), bottom = std::clamp(part.bottom, 0, height);
    if (left >= right || top >= bottom || part.indices == 0) continue;
    triangles.parts.push_back({Surface::panel, first_index + part.first_index, part.indices, left, top,
                               right - left, bottom - top});
  }
}

}  // namespace

bool hasPicture(const Shown& frame) {
  return frame.picture != nullptr && frame.picture->width > 0 && frame.picture->height > 0;
}

bool isSharp(const Shown& frame, int width, int height) {
  const Placement& at = frame.placement;
  return hasPicture(frame) && frame.picture->width == width && frame.picture->height == height &&
         at.left == 0 && at.top == 0 && at.width == width && at.height == height;
}

void putOverBackground(const Image& picture, std::span<std::uint32_t> to) {
  assert(to.size() == picture.rgba.size());
  std::ranges::transform(picture.rgba, to.begin(), overBackground);
}

FrameTriangles trianglesOf(const Shown& frame, int width, int height) {
  FrameTriangles triangles;
  if (hasPicture(frame) && !isSharp(frame, width, height))
    addPicture(frame.placement, width, height, triangles);
  if (frame.panel != nullptr) addPanel(*frame.panel, width, height, triangles);
  for (PanelVertex& vertex : triangles.vertices) {
    vertex.x = 2 * vertex.x / static_cast<float>(width) - 1;
    vertex.y = 2 * vertex.y / static_cast<float>(height) - 1;
  }
  return triangles;
}

}  // namespace vorpipe::view
