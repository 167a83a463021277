// The panel's groups for what moves sites: relaxation and fluids.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "view/widgets.h"

namespace vorpipe::view {
namespace {

// In the order of RelaxMethod.
const std::array<std::string, 2> method_names{"L-BFGS", "Lloyd"};

/// Draws the first two of `count` buttons that fill the rest of a row.
void drawRunAndStep(PanelFrame& frame, int count) {
  const bool runs = frame.input.settings.motion == Motion::runs;
  if (frame.widgets.chip("Run", runs ? "Pause" : "Run", Widgets::share(count), runs)) {
    frame.result.actions.push_back(runs ? Action::pause : Action::run);
  }
  ImGui::SameLine();
  if (frame.widgets.button("Step", "Step", Widgets::share(count - 1), !runs)) {
    frame.result.actions.push_back(Action::step);
  }
}

void drawEnergies(const Widgets& widgets, const std::vector<float>& energies) {
  const float width = ImGui::GetContentRegionAvail().x, height = widgets.px(30);
  const ImVec2 at = Widgets::chart(width, height);
  const auto [least, most] = std::ranges::minmax_element(energies);
  const float span = std::max(*most - *least, 1e-6F), pad = widgets.px(4);
  std::vector<ImVec2> points;
  for (std::size_t i = 0; i < energies.size(); ++i) {
    const float along = static_cast<float>(i) / static_cast<float>(energies.size() - 1);
    points.emplace_back(at.x + pad + (width - 2 * pad) * along,
                        at.y + pad + (height - 2 * pad) * (*most - energies[i]) / span);
  }
  ImGui::GetWindowDrawList()->AddPolyline(points.data(), static_cast<int>(points.size()), look::accent, 0,
                                          widgets.px(1.5F));
}

void drawDensity(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  Settings& settings = frame.result.settings;
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
  widgets.value(fileName(settings.density_path));
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

const std::array<std::uint64_t, 4> parcel_counts{512, 2048, 8192, 32768};

void drawCases(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  const std::optional<FluidShown>& fluid = frame.input.fluid;
  widgets.row("Case");
  const std::vector<std::string> names = fluidCaseNames();
  const std::string name = fluid ? fileName(fluid->name) : "none";
  if (!widgets.beginList("Case", name.c_str())) return;
  for (const std::string& each : names) {
    if (widgets.item("Case/" + each, each.c_str(), fluid && fluid->name == each)) {
      frame.result.begins = fluidCaseOf(each);
    }
  }
  widgets.endList();
}

/// Draws the choice of the number of cells. A present case restarts with the new number.
void drawCounts(PanelFrame& frame) {
  frame.widgets.row("Cells");
  std::vector<std::string> labels;
  int current = -1;
  for (const std::uint64_t count : parcel_counts) {
    if (count == frame.result.settings.parcels) current = static_cast<int>(labels.size());
    labels.push_back(fmt::format("{}", count));
  }
  const int chosen = frame.widgets.choice("Parcels", labels, current);
  if (chosen < 0) return;
  frame.result.settings.parcels = parcel_counts.at(static_cast<std::size_t>(chosen));
  if (frame.input.fluid) frame.result.begins = fluidCaseOf(frame.input.fluid->name);
}

void drawMotion(PanelFrame& frame) {
  drawRunAndStep(frame, 3);
  ImGui::SameLine();
  if (frame.widgets.button("Begin again", "Again", Widgets::share(1))) {
    frame.result.actions.push_back(Action::begin_again);
  }
  frame.widgets.tooltip("Begins again, as it was at first");
}

void drawNumbers(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  const FluidShown& fluid = *frame.input.fluid;
  const FluidStep& last = fluid.last;
  widgets.row("Time");
  widgets.value(fmt::format("{:.4f}, step {}", last.time, last.step));
  widgets.row("Speed");
  const bool flows = fluid.steps_per_second > 0;
  widgets.value(flows ? fmt::format("{:.3g} steps/s", fluid.steps_per_second) : "\u2013",
                flows ? look::text : look::dim);
  widgets.row("Energy");
  widgets.value(fmt::format("{:.6g}", last.energy()));
  widgets.tooltip(fmt::format("kinetic {:.6g}\npotential {:.6g}\nof springs {:.6g}", last.kinetic,
                              last.potential, last.spring));
  widgets.row("Areas");
  widgets.value(fmt::format("within {:.1e}", last.worst));
  widgets.tooltip("The largest difference of an area from its own, as a part of that");
}

void drawOptions(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  FluidOptions options = frame.input.fluid->options;
  const bool is_full = options.surface == vorpipe::Surface::none;
  widgets.row("Scheme");
  std::vector<std::string> schemes = namesFrom<FluidScheme>();
  schemes.pop_back();  // auto, which is one of the others
  const int scheme = widgets.choice("Scheme", schemes, static_cast<int>(schemeOf(options)), is_full);
  if (!is_full) widgets.tooltip("Projection is for domains that are full");
  if (scheme >= 0 && scheme != static_cast<int>(schemeOf(options))) {
    options.scheme = static_cast<FluidScheme>(scheme);
    frame.result.flows_by = options;
  }
  const double most = std::max(10.0, std::ceil(std::abs(options.gravity.y)));
  if (widgets.slider("Gravity", "Gravity", options.gravity.y, -most, most, "%.2f"))
    frame.result.flows_by = options;
  widgets.tooltip("Upward; what falls is pulled by less than 0");
}

void drawStirring(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  Brush& brush = frame.result.settings.brush;
  double percent = 100 * brush.radius;
  if (widgets.slider("Brush", "Brush", percent, 1, 50, "%.0f %%")) brush.radius = percent / 100;
  widgets.tooltip("The radius of what a left drag stirs, of the shorter side of the domain");
  widgets.slider("Push", "Push", brush.push, 0.1, 5, "%.1f");
  widgets.tooltip("How much a drag adds, in speeds that are usual in the fluid");
}

}  // namespace

void drawRelax(PanelFrame& frame, const std::vector<float>& energies) {
  Widgets& widgets = frame.widgets;
  Settings& settings = frame.result.settings;
  if (!widgets.group("Relax")) return;
  const int method =
      widgets.choice("Method", method_names, static_cast<int>(settings.method), true, Widgets::share(2));
  if (method >= 0) settings.method = static_cast<RelaxMethod>(method);
  ImGui::SameLine();
  drawRunAndStep(frame, 2);
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

void drawFluid(PanelFrame& frame) {
  if (!frame.widgets.group("Fluid")) return;
  drawCases(frame);
  if (!frame.input.fluid) return;
  drawCounts(frame);
  drawMotion(frame);
  drawNumbers(frame);
  drawOptions(frame);
  drawStirring(frame);
}

}  // namespace vorpipe::view
