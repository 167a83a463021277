#include "view/style.h"

#include <initializer_list>

namespace vorpipe::view {
namespace {

void setColors(ImGuiStyle& style) {
  const auto set = [&style](ImGuiCol which, ImU32 color) {
    style.Colors[which] = ImGui::ColorConvertU32ToFloat4(color);
  };
  set(ImGuiCol_Text, look::text);
  set(ImGuiCol_TextDisabled, look::dim);
  set(ImGuiCol_WindowBg, look::surface);
  set(ImGuiCol_PopupBg, IM_COL32(38, 42, 49, 252));
  set(ImGuiCol_Border, look::line);
  for (const ImGuiCol which : {ImGuiCol_FrameBg, ImGuiCol_Button}) set(which, look::field);
  for (const ImGuiCol which :
       {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive}) {
    set(which, look::field_hovered);
  }
  set(ImGuiCol_SliderGrab, look::accent);
  set(ImGuiCol_SliderGrabActive, look::accent_hovered);
  set(ImGuiCol_Header, IM_COL32(46, 51, 60, 255));
  set(ImGuiCol_HeaderHovered, look::field_hovered);
  set(ImGuiCol_HeaderActive, look::field_hovered);
  set(ImGuiCol_Separator, look::line);
  set(ImGuiCol_ScrollbarBg, IM_COL32(0, 0, 0, 0));
  set(ImGuiCol_ScrollbarGrab, IM_COL32(72, 78, 90, 255));
  set(ImGuiCol_ScrollbarGrabHovered, IM_COL32(90, 97, 110, 255));
  set(ImGuiCol_ScrollbarGrabActive, look::accent);
  set(ImGuiCol_TextSelectedBg, IM_COL32(74, 144, 217, 110));
}

}  // namespace

void setStyle(double scale) {
  ImGuiStyle style;
  setColors(style);
  style.WindowPadding = {12, 10};
  style.FramePadding = {7, 3};
  style.ItemSpacing = {6, 4};
  style.ItemInnerSpacing = {5, 4};
  style.WindowRounding = 8;
  style.PopupRounding = 6;
  style.FrameRounding = 4;
  style.GrabRounding = 3;
  style.GrabMinSize = 10;
  style.ScrollbarSize = 9;
  style.ScrollbarRounding = 4;
  style.WindowBorderSize = 1;
  style.PopupBorderSize = 1;
  style.DisabledAlpha = 0.45F;
  style.WindowMinSize = {16, 16};
  style.ScaleAllSizes(static_cast<float>(scale));
  ImGui::GetStyle() = style;
}

}  // namespace vorpipe::view
