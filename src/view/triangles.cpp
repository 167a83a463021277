#include "view/triangles.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

namespace vorpipe::view {
namespace {

std::int32_t inside(float value, int size) {
  return static_cast<std::int32_t>(std::clamp(value, 0.0F, static_cast<float>(size)));
}

void add(const ImDrawList& list, int width, int height, PanelTriangles& triangles) {
  const auto base = static_cast<std::uint32_t>(triangles.vertices.size());
  for (const ImDrawVert& vertex : list.VtxBuffer) {
    triangles.vertices.push_back({vertex.pos.x, vertex.pos.y, vertex.uv.x, vertex.uv.y, vertex.col});
  }
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const PanelPart part{
        static_cast<std::uint32_t>(triangles.indices.size()), command.ElemCount,
        inside(std::floor(command.ClipRect.x), width),        inside(std::floor(command.ClipRect.y), height),
        inside(std::ceil(command.ClipRect.z), width),         inside(std::ceil(command.ClipRect.w), height)};
    if (part.indices == 0 || part.left >= part.right || part.top >= part.bottom) continue;
    for (unsigned i = 0; i < command.ElemCount; ++i) {
      const ImDrawIdx index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i)];
      triangles.indices.push_back(base + command.VtxOffset + index);
    }
    triangles.parts.push_back(part);
  }
}

}  // namespace

void takeTriangles(int width, int height, PanelTriangles& triangles) {
  triangles.vertices.clear();
  triangles.indices.clear();
  triangles.parts.clear();
  const ImDrawData& drawn = *ImGui::GetDrawData();
  for (int i = 0; i < drawn.CmdListsCount; ++i) add(*drawn.CmdLists[i], width, height, triangles);
  if (triangles.parts.empty()) triangles.vertices.clear();
}

}  // namespace vorpipe::view
