#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "view/groups.h"
#include "view/style.h"

namespace vorpipe::view {
namespace {

// In the order of FluidScheme.
const std::array<std::string, 2> scheme_names{"springs", "projection"};
const std::array<std::uint64_t, 4> parcel_counts{512, 2048, 8192, 32768};

/// Draws the list of cases.
void drawCases(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  const std::optional<FluidShown>& fluid = frame.input.fluid;
  widgets.row("Case");
  const std::vector<std::string> names = fluidCaseNames();
  const std::string name = fluid ? fileName(fluid->name) : "none";
  if (!widgets.beginList("Case", name.c_str())) return;
  for (const std::string& each : names) {
    if (widgets.item("Case/" + each, each.c_str(), fluid && fluid->name == each)) {
      frame.answer.begins = fluidCaseOf(each);
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
    if (count == frame.answer.settings.parcels) current = static_cast<int>(labels.size());
    labels.push_back(fmt::format("{}", count));
  }
  const int chosen = frame.widgets.choice("Parcels", labels, current);
  if (chosen < 0) return;
  frame.answer.settings.parcels = parcel_counts.at(static_cast<std::size_t>(chosen));
  if (frame.input.fluid) frame.answer.begins = fluidCaseOf(frame.input.fluid->name);
}

void drawMotion(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  const bool runs = frame.input.settings.motion == Motion::runs;
  if (widgets.chip("Run", runs ? "Pause" : "Run", Widgets::share(3), runs)) {
    frame.answer.actions.push_back(runs ? Action::pause : Action::run);
  }
  ImGui::SameLine();
  if (widgets.button("Step", "Step", Widgets::share(2), !runs)) frame.answer.actions.push_back(Action::step);
  ImGui::SameLine();
  if (widgets.button("Begin again", "Again", Widgets::share(1))) {
    frame.answer.actions.push_back(Action::begin_again);
  }
  widgets.tooltip("Begins again, as it was at first");
}

void drawNumbers(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  const FluidShown& fluid = *frame.input.fluid;
  const FluidStep& last = fluid.last;
  widgets.row("Time");
  widgets.value(fmt::format("{:.4f}, step {}", last.time, last.step), look::text);
  widgets.row("Speed");
  const bool flows = fluid.steps_per_second > 0;
  widgets.value(flows ? fmt::format("{:.3g} steps/s", fluid.steps_per_second) : "\u2013",
                flows ? look::text : look::dim);
  widgets.row("Energy");
  widgets.value(fmt::format("{:.6g}", last.energy()), look::text);
  widgets.tooltip(fmt::format("kinetic {:.6g}\npotential {:.6g}\nof springs {:.6g}", last.kinetic,
                              last.potential, last.spring));
  widgets.row("Areas");
  widgets.value(fmt::format("within {:.1e}", last.worst), look::text);
  widgets.tooltip("The largest difference of an area from its own, as a part of that");
}

void drawOptions(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  FluidOptions options = frame.input.fluid->options;
  const bool is_full = options.surface == vorpipe::Surface::none;
  widgets.row("Scheme");
  const int scheme = widgets.choice("Scheme", scheme_names, static_cast<int>(options.scheme), is_full);
  if (!is_full) widgets.tooltip("Projection is for domains that are full");
  if (scheme >= 0 && scheme != static_cast<int>(options.scheme)) {
    options.scheme = static_cast<FluidScheme>(scheme);
    frame.answer.flows_by = options;
  }
  widgets.row("Gravity");
  const double most = std::max(10.0, std::ceil(std::abs(options.gravity.y)));
  if (widgets.slider("Gravity", options.gravity.y, -most, most, "%.2f")) frame.answer.flows_by = options;
  widgets.tooltip("Upward; what falls is pulled by less than 0");
}

void drawStirring(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  Brush& brush = frame.answer.settings.brush;
  widgets.row("Brush");
  double percent = 100 * brush.radius;
  if (widgets.slider("Brush", percent, 1, 50, "%.0f %%")) brush.radius = percent / 100;
  widgets.tooltip("The radius of what a left drag stirs, of the shorter side of the domain");
  widgets.row("Push");
  widgets.slider("Push", brush.push, 0.1, 5, "%.1f");
  widgets.tooltip("How much a drag adds, in speeds that are usual in the fluid");
}

}  // namespace

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
