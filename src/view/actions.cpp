#include <span>

#include "view/groups.h"

namespace vorpipe::view {
namespace {

struct ActionButton {
  const char* name;
  const char* label;
  Action action;
  const char* tip;
  bool enabled = true;
};

/// Draws buttons that fill the rest of a row, with widths according to the lengths of their labels.
void drawButtons(PanelFrame& frame, std::span<const ActionButton> buttons) {
  const float gap = ImGui::GetStyle().ItemSpacing.x,
              right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
  float asked = 0;
  for (const ActionButton& button : buttons) asked += ImGui::CalcTextSize(button.label).x + gap;
  const float more = (ImGui::GetContentRegionAvail().x + gap - asked) / static_cast<float>(buttons.size());
  for (const ActionButton& button : buttons) {
    const bool last = &button == &buttons.back();
    const float width = last ? right - ImGui::GetCursorPosX() : ImGui::CalcTextSize(button.label).x + more;
    if (frame.widgets.button(button.name, button.label, width, button.enabled)) {
      frame.answer.actions.push_back(button.action);
    }
    frame.widgets.tooltip(button.tip);
    if (!last) ImGui::SameLine();
  }
}

}  // namespace

void drawActions(PanelFrame& frame) {
  const ActionButton first[] = {{"Undo", "Undo", Action::undo, "What was changed last", frame.input.can_undo},
                                {"Redo", "Redo", Action::redo, "What was undone last", frame.input.can_redo},
                                {"Fit", "Fit", Action::fit, "Shows the whole domain"},
                                {"Copy command", "Copy command", Action::copy_command,
                                 "The command line that makes this picture, to the clipboard"}};
  const ActionButton second[] = {{"PNG", "PNG", Action::save_png, "The picture, without the panel"},
                                 {"SVG", "SVG", Action::save_svg, "The picture as polygons and lines"},
                                 {"Save sites", "Sites", Action::save_sites, "The sites, as .csv"}};
  drawButtons(frame, first);
  frame.widgets.row("Save");
  drawButtons(frame, second);
}

}  // namespace vorpipe::view
