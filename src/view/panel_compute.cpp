// The panel's groups for what computes: backends, devices and times.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "view/widgets.h"

namespace vorpipe::view {
namespace {

std::ptrdiff_t devicesOf(const std::vector<DeviceInfo>& devices, const std::string& backend) {
  return std::ranges::count(devices, backend, &DeviceInfo::backend);
}

/// Returns the shortest BackendOptions::device that selects the device at `index`.
std::string deviceOption(const std::vector<DeviceInfo>& devices, std::size_t index) {
  const DeviceInfo& device = devices[index];
  if (devicesOf(devices, device.backend) == 1) return {};
  std::size_t alike = 0, before = 0;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].backend != device.backend) continue;
    if (devices[i].name.find(device.name) != std::string::npos) ++alike;
    if (i < index) ++before;
  }
  return alike == 1 ? device.name : fmt::format("{}", before);
}

std::string titleOf(const DeviceInfo& info) {
  return info.name.empty() || info.name == info.backend
             ? info.backend
             : fmt::format("{} \u00b7 {}", info.backend, info.name);
}

/// Draws the devices as items, named `list`/backend, of an open list. Calls `choose` for a chosen one that is
/// available.
template <class Choose>
void drawDevices(PanelFrame& frame, const char* list, const BackendOptions& chosen, const Choose& choose) {
  Widgets& widgets = frame.widgets;
  const std::vector<DeviceInfo>& devices = frame.input.devices;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceInfo& info = devices[i];
    const std::string option = deviceOption(devices, i);
    const bool first = option.empty() || devicesOf(devices, info.backend) == 1;
    const bool current =
        info.backend == chosen.name && (chosen.device == option || (first && chosen.device.empty()));
    const std::string title = titleOf(info);
    std::string name = fmt::format("{}/{}", list, info.backend);
    if (widgets.placements.contains(name)) name += fmt::format("/{}", option);
    if (widgets.item(name, title.c_str(), current, info.usable)) choose(info.backend, option);
    if (!info.usable) widgets.tooltip(info.reason);
  }
}

std::string nameOf(const BackendOptions& chosen) {
  return chosen.device.empty() ? chosen.name : fmt::format("{} \u00b7 {}", chosen.name, chosen.device);
}

void drawBackend(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  BackendOptions& chosen = frame.result.settings.backend;
  const auto choose = [&chosen](const std::string& backend, const std::string& device) {
    chosen.name = backend;
    chosen.device = device;
  };
  widgets.row("Backend");
  if (!widgets.beginList("Backend", nameOf(chosen).c_str())) return;
  if (widgets.item("Backend/auto", "auto", chosen.name == "auto")) choose("auto", "");
  drawDevices(frame, "Backend", chosen, choose);
  widgets.endList();
}

void drawCompared(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  Settings& settings = frame.result.settings;
  widgets.row("Compare");
  if (widgets.beginList("Compare", settings.compared ? nameOf(*settings.compared).c_str() : "with none")) {
    if (widgets.item("Compare/none", "with none", !settings.compared)) settings.compared.reset();
    BackendOptions none{};
    none.name.clear();
    drawDevices(frame, "Compare", settings.compared.value_or(none),
                [&](const std::string& backend, const std::string& device) {
                  settings.compared = comparedWith(settings.backend, backend, device);
                });
    widgets.endList();
  }
  if (!settings.compared) return;
  widgets.slider("Wipe", "Wipe", settings.split, 0, 1, "%.2f");
  widgets.row("Differ");
  const auto& compared = frame.input.compared;
  widgets.value(compared ? fmt::format("{} of {} pixels", compared->differing, compared->pixels) : "\u2013");
}

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
  const ImVec2 at = Widgets::chart(width, height);
  ImDrawList& list = *ImGui::GetWindowDrawList();
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

void drawDevice(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  if (!widgets.group("Compute")) return;
  drawBackend(frame);
  drawCompared(frame);
  for (const auto& [label, name] :
       {std::pair("Drawn by", frame.input.computed_by), std::pair("Shown by", frame.input.presenter)}) {
    if (name.empty()) continue;
    widgets.row(label);
    widgets.value(name);
  }
}

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
