#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "view/groups.h"
#include "view/style.h"

namespace vorpipe::view {
namespace {

std::size_t devicesOf(const std::vector<DeviceInfo>& devices, const std::string& backend) {
  return static_cast<std::size_t>(std::count_if(
      devices.begin(), devices.end(), [&](const DeviceInfo& info) { return info.backend == backend; }));
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
    if (widgets.places.contains(name)) name += fmt::format("/{}", option);
    if (widgets.item(name, title.c_str(), current, info.usable)) choose(info.backend, option);
    if (!info.usable) widgets.tooltip(info.reason);
  }
}

std::string nameOf(const BackendOptions& chosen) {
  return chosen.device.empty() ? chosen.name : fmt::format("{} \u00b7 {}", chosen.name, chosen.device);
}

void drawBackend(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  BackendOptions& chosen = frame.answer.settings.backend;
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
  Settings& settings = frame.answer.settings;
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
  widgets.row("Wipe");
  widgets.slider("Wipe", settings.wipe, 0, 1, "%.2f");
  widgets.row("Differ");
  const auto& compared = frame.input.compared;
  widgets.value(compared ? fmt::format("{} of {} pixels", compared->differing, compared->pixels) : "\u2013",
                look::text);
}

}  // namespace

void drawDevice(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  if (!widgets.group("Compute")) return;
  drawBackend(frame);
  drawCompared(frame);
  if (!frame.input.computed_by.empty()) {
    widgets.row("Drawn by");
    widgets.value(frame.input.computed_by, look::text);
  }
  if (!frame.input.presenter.empty()) {
    widgets.row("Shown by");
    widgets.value(frame.input.presenter, look::text);
  }
}

}  // namespace vorpipe::view
