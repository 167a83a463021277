#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "view/groups.h"
#include "view/style.h"

namespace vorpipe::view {
namespace {

struct StageTime {
  const char* name;
  double milliseconds;
  ImU32 color;
};

std::array<StageTime, 6> stagesOf(const FrameTimes& times) {
  const double known = times.order + times.cells + times.draw + times.download + times.present;
  return {{{"order", times.order, IM_COL32(122, 137, 194, 255)},
           {"cells", times.cells, look::accent},
           {"draw", times.draw, IM_COL32(84, 178, 160, 255)},
           {"download", times.download, IM_COL32(214, 170, 84, 255)},
           {"present", times.present, IM_COL32(206, 112, 92, 255)},
           {"other", std::max(0.0, times.frame - known), IM_COL32(112, 118, 130, 255)}}};
}

std::string milliseconds(double value) {
  if (value <= 0) return "0 ms";
  return value < 100 ? fmt::format("{:.1f} ms", value) : fmt::format("{:.0f} ms", value);
}

/// Returns the smallest of 1, 2 and 5 times a power of ten that is not below `most`.
double scaleFor(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(std::max(most, 1.0))));
  for (const double times : {1.0, 2.0, 5.0}) {
    if (most <= times * power) return times * power;
  }
  return 10 * power;
}

void drawHistory(const Widgets& widgets, const std::vector<float>& history) {
  const float width = ImGui::GetContentRegionAvail().x, height = widgets.px(40);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, IM_COL32(22, 24, 29, 255),
                     ImGui::GetStyle().FrameRounding);
  const float step = widgets.px(3), bar = widgets.px(2), pad = widgets.px(4);
  const auto room = static_cast<std::size_t>(std::max(0.0F, (width - 2 * pad) / step));
  const std::size_t shown = std::min(room, history.size());
  float most = 0;
  for (std::size_t i = history.size() - shown; i < history.size(); ++i) most = std::max(most, history[i]);
  const double scale = scaleFor(double{most});
  for (std::size_t i = 0; i < shown; ++i) {
    const float value = history[history.size() - 1 - i];
    const float left = at.x + width - pad - static_cast<float>(i + 1) * step;
    const float top = at.y + height - pad - (height - 2 * pad) * static_cast<float>(double{value} / scale);
    list.AddRectFilled({left, std::min(std::round(top), at.y + height - pad - 1)},
                       {left + bar, at.y + height - pad},
                       i == 0 ? look::accent_hovered : IM_COL32(74, 144, 217, 150));
  }
  const std::string label = fmt::format("{:.0f} ms", scale);
  list.AddText({at.x + pad + 1, at.y + widgets.px(1)}, look::dim, label.c_str());
}

void drawSpent(const Widgets& widgets, const std::array<StageTime, 6>& stages) {
  const float width = ImGui::GetContentRegionAvail().x, height = widgets.px(8);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  double whole = 0;
  for (const StageTime& stage : stages) whole += std::max(0.0, stage.milliseconds);
  if (whole <= 0) return;
  double before = 0;
  for (const StageTime& stage : stages) {
    const double after = before + std::max(0.0, stage.milliseconds);
    const float left = std::round(at.x + width * static_cast<float>(before / whole));
    const float right = std::round(at.x + width * static_cast<float>(after / whole));
    if (right > left)
      ImGui::GetWindowDrawList()->AddRectFilled({left, at.y}, {right, at.y + height}, stage.color);
    before = after;
  }
}

}  // namespace

void drawTimes(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  const FrameTimes& times = frame.input.times;
  if (!widgets.group("Frame time", times.frame > 0 ? milliseconds(times.frame) : "")) return;
  drawHistory(widgets, times.history);
  const std::array<StageTime, 6> stages = stagesOf(times);
  drawSpent(widgets, stages);
  const float column = std::floor(ImGui::GetContentRegionAvail().x / 2), left = ImGui::GetCursorPosX();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const StageTime& stage = stages[i];
    const float begin = left + (i % 2 == 0 ? 0 : column);
    if (i % 2 == 1) ImGui::SameLine(begin);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = widgets.px(8), down = std::round((ImGui::GetTextLineHeight() - side) / 2);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + down}, {at.x + side, at.y + down + side},
                                              stage.color, 2);
    ImGui::SetCursorPosX(begin + side + widgets.px(6));
    Widgets::dim(stage.name);
    const std::string text = milliseconds(stage.milliseconds);
    ImGui::SameLine(begin + column - widgets.px(i % 2 == 0 ? 12 : 0) - ImGui::CalcTextSize(text.c_str()).x);
    ImGui::TextUnformatted(text.c_str());
  }
}

}  // namespace vorpipe::view
