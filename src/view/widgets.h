/// What the panel is made of: things to read, to switch, to choose and to press.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <imgui.h>

#include "view/panel.h"

namespace vorpipe::view {

/// Draws into the current window of Dear ImGui, at a scale, and notes where each thing stands by its name.
class Widgets {
 public:
  explicit Widgets(double scale) : scale_(static_cast<float>(scale)) {}

  /// Where what was drawn stands, and the windows that keep the pointer from what is below.
  PanelPlaces places;
  std::vector<Placement> covered;
  bool closes_list = false;  ///< the list that is open

  /// A length in units, pixels of a usual screen, in pixels of this one.
  [[nodiscard]] float px(float units) const;
  void note(std::string_view name);  ///< the item that was drawn last
  void cover();                      ///< the current window keeps the pointer

  /// A heading that opens and closes what is below, with what is to be seen of it even then on the right.
  /// Whether it is open.
  bool group(const char* name, std::string_view summary = "");
  /// Begins a row: what it is about; its items follow in the column on the right.
  void row(const char* label);
  /// Text in a row; where it is too long it ends in three dots, and the tooltip has it whole.
  void value(std::string_view text, ImU32 color);
  /// A line of what is less important.
  static void dim(std::string_view text);
  /// Of the item before, where the pointer rests on it.
  void tooltip(std::string_view text) const;

  /// A button that fills `width` pixels. Whether it was pressed.
  bool button(std::string_view name, const char* label, float width, bool enabled = true);
  /// One that stays lit while `on`. Whether it was pressed.
  bool chip(std::string_view name, const char* label, float width, bool on, bool enabled = true);
  /// A chip that changes what it shows.
  void toggle(const char* name, float width, bool& on, bool enabled = true);
  /// Side by side, of which one is lit, in `width` pixels or what there is. The one that was pressed, or -1.
  int choice(std::string_view name, std::span<const std::string> labels, int current, bool enabled = true,
             float width = 0);
  /// As wide as there is room. Whether the value changed.
  bool slider(std::string_view name, double& value, double least, double most, const char* format,
              bool enabled = true);
  /// A list that opens: what it is closed; if it returns true, draw its items, then call endList().
  bool beginList(std::string_view name, const char* preview, bool enabled = true);
  void endList();
  /// An item of a list. Whether it was chosen.
  bool item(std::string_view name, const char* label, bool current, bool enabled = true);

  /// The width of each of `count` items that fill what is left of a row.
  [[nodiscard]] static float share(int count);

 private:
  bool pressable(std::string_view name, const char* label, ImVec2 size, bool on, bool enabled,
                 ImDrawFlags corners);
  float scale_;
};

}  // namespace vorpipe::view
