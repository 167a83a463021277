/// Color samples of color maps, for choosing one.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <imgui.h>

namespace vorpipe::view {

/// A color map and some of its colors, from the first to the last, R in the lowest byte.
struct Swatch {
  std::string name;
  std::vector<ImU32> colors;
};

/// The swatches of colormaps(), in its order.
const std::vector<Swatch>& swatches();

/// Draws colors side by side, each shading into the next, from one corner to the opposite.
void drawSwatch(std::span<const ImU32> colors, ImVec2 from, ImVec2 to);

}  // namespace vorpipe::view
