/// The panel's widgets: texts, switches, choices and buttons.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <imgui.h>

#include "view/panel.h"

namespace vorpipe::view {

/// Draws into the current window of Dear ImGui, at a scale, and records each widget's position by its name.
class Widgets {
 public:
  explicit Widgets(double scale) : scale_(static_cast<float>(scale)) {}

  /// Positions of what was drawn, and the windows that block the pointer from what is below them.
  PanelPlaces places;
  std::vector<Placement> covered;
  bool closes_list = false;  ///< closes the open list

  /// Converts a length in units (pixels of a usual screen) to pixels of this one.
  [[nodiscard]] float px(float units) const;
  void note(std::string_view name);  ///< records the item drawn last
  void cover();                      ///< makes the current window block the pointer

  /// Draws a heading that opens and closes the group below; `summary`, on its right, is always visible.
  /// Returns whether it is open.
  bool group(const char* name, std::string_view summary = "");
  /// Begins a row with its label; its items follow in the column on the right.
  void row(const char* label);
  /// Draws text in a row; if too long, it ends in three dots and the tooltip shows all of it.
  void value(std::string_view text, ImU32 color);
  /// Draws a line of less important text.
  static void dim(std::string_view text);
  /// Shows a tooltip while the pointer rests on the previous item.
  void tooltip(std::string_view text) const;

  /// Draws a button `width` pixels wide. Returns whether it was pressed.
  bool button(std::string_view name, const char* label, float width, bool enabled = true);
  /// Draws a button that stays lit while `on`. Returns whether it was pressed.
  bool chip(std::string_view name, const char* label, float width, bool on, bool enabled = true);
  /// Draws a chip that toggles `on`.
  void toggle(const char* name, float width, bool& on, bool enabled = true);
  /// Draws buttons side by side, one of them lit, in `width` pixels or the available width. Returns the index
  /// of the pressed one, or -1.
  int choice(std::string_view name, std::span<const std::string> labels, int current, bool enabled = true,
             float width = 0);
  /// Draws a slider as wide as there is room. Returns whether the value changed.
  bool slider(std::string_view name, double& value, double least, double most, const char* format,
              bool enabled = true);
  /// Begins a drop-down list that shows `preview` when closed. If it returns true, draw its items, then call
  /// endList().
  bool beginList(std::string_view name, const char* preview, bool enabled = true);
  void endList();
  /// Draws an item of a list. Returns whether it was chosen.
  bool item(std::string_view name, const char* label, bool current, bool enabled = true);

  /// Returns the width of each of `count` items that fill the rest of a row.
  [[nodiscard]] static float share(int count);

 private:
  bool pressable(std::string_view name, const char* label, ImVec2 size, bool on, bool enabled,
                 ImDrawFlags corners);
  float scale_;
};

}  // namespace vorpipe::view
