/// How the panel looks.
#pragma once

#include <imgui.h>

namespace vorpipe::view {

/// Colors with R in the lowest byte, like ImGui's.
namespace look {
inline constexpr ImU32 accent = IM_COL32(74, 144, 217, 255), accent_hovered = IM_COL32(96, 163, 232, 255);
inline constexpr ImU32 field = IM_COL32(52, 57, 66, 255), field_hovered = IM_COL32(66, 72, 83, 255);
inline constexpr ImU32 text = IM_COL32(226, 229, 234, 255), dim = IM_COL32(148, 155, 166, 255);
inline constexpr ImU32 heading = IM_COL32(130, 180, 232, 255);
inline constexpr ImU32 on_accent = IM_COL32(255, 255, 255, 255);
inline constexpr ImU32 surface = IM_COL32(30, 33, 39, 242), line = IM_COL32(60, 65, 75, 255);
}  // namespace look

/// Sets colors and sizes of Dear ImGui's context.
void setStyle(double scale);

}  // namespace vorpipe::view
