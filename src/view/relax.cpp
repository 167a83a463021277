#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "view/groups.h"
#include "view/style.h"

namespace vorpipe::view {
namespace {

// In the order of RelaxMethod.
const std::array<std::string, 2> method_names{"L-BFGS", "Lloyd"};

void drawEnergies(const Widgets& widgets, const std::vector<float>& energies) {
  const float width = ImGui::GetContentRegionAvail().x, height = widgets.px(30);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, IM_COL32(22, 24, 29, 255),
                     ImGui::GetStyle().FrameRounding);
  if (energies.size() < 2) return;
  const auto [least, most] = std::minmax_element(energies.begin(), energies.end());
  const float span = std::max(*most - *least, 1e-6F), pad = widgets.px(4);
  std::vector<ImVec2> points;
  for (std::size_t i = 0; i < energies.size(); ++i) {
    const float along = static_cast<float>(i) / static_cast<float>(energies.size() - 1);
    points.emplace_back(at.x + pad + (width - 2 * pad) * along,
                        at.y + pad + (height - 2 * pad) * (*most - energies[i]) / span);
  }
  list.AddPolyline(points.data(), static_cast<int>(points.size()), look::accent, 0, widgets.px(1.5F));
}

void drawDensity(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  Settings& settings = frame.answer.settings;
  widgets.row("Density");
  if (settings.density_path.empty()) {
    widgets.value("none", look::dim);
    return;
  }
  const float side = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemSpacing.x;
  const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
  ImGui::PushClipRect(ImGui::GetCursorScreenPos(),
                      {ImGui::GetCursorScreenPos().x + right - ImGui::GetCursorPosX() - side - gap,
                       ImGui::GetCursorScreenPos().y + side},
                      true);
  widgets.value(fileName(settings.density_path), look::text);
  ImGui::PopClipRect();
  widgets.tooltip(settings.density_path);
  ImGui::SameLine(right - side);
  if (widgets.button("No density", "\u00d7", side)) {
    settings.density_path.clear();
    settings.density = {};
  }
  widgets.tooltip("Relax without a density");
}

std::string energyText(const RelaxStep& step) {
  return std::isfinite(step.hexagonal) ? fmt::format("{:.5f} after {} diagrams", step.hexagonal, step.diagram)
                                       : fmt::format("{:.6g} after {} diagrams", step.energy, step.diagram);
}

}  // namespace

void drawRelax(PanelFrame& frame, const std::vector<float>& energies) {
  Widgets& widgets = frame.widgets;
  Settings& settings = frame.answer.settings;
  if (!widgets.group("Relax")) return;
  const int method =
      widgets.choice("Method", method_names, static_cast<int>(settings.method), true, Widgets::share(2));
  if (method >= 0) settings.method = static_cast<RelaxMethod>(method);
  const bool runs = frame.input.settings.motion == Motion::runs;
  ImGui::SameLine();
  if (widgets.chip("Run", runs ? "Pause" : "Run", Widgets::share(2), runs)) {
    frame.answer.actions.push_back(runs ? Action::pause : Action::run);
  }
  ImGui::SameLine();
  if (widgets.button("Step", "Step", Widgets::share(1), !runs)) frame.answer.actions.push_back(Action::step);
  const std::optional<RelaxStep>& step = frame.input.relaxed;
  widgets.row("Energy");
  widgets.value(step ? energyText(*step) : "\u2013", step ? look::text : look::dim);
  const bool weighted = step && !std::isfinite(step->hexagonal);
  widgets.tooltip(weighted
                      ? "The squared distance to the site, less its weight, summed over all of the domain"
                      : "Over that of the hexagonal lattice, which is the least: 1");
  if (energies.size() > 1) drawEnergies(widgets, energies);
  drawDensity(frame);
}

}  // namespace vorpipe::view
