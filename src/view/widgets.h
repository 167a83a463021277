/// The panel's widgets and look, and the groups made of them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <imgui.h>

#include "view/panel.h"

namespace vorpipe::view {

/// Colors with R in the lowest byte, like ImGui's.
namespace look {
inline constexpr ImU32 accent = IM_COL32(74, 144, 217, 255), accent_hovered = IM_COL32(96, 163, 232, 255);
inline constexpr ImU32 field = IM_COL32(52, 57, 66, 255), field_hovered = IM_COL32(66, 72, 83, 255);
inline constexpr ImU32 text = IM_COL32(226, 229, 234, 255), dim = IM_COL32(148, 155, 166, 255);
inline constexpr ImU32 heading = IM_COL32(130, 180, 232, 255);
inline constexpr ImU32 on_accent = IM_COL32(255, 255, 255, 255);
inline constexpr ImU32 surface = IM_COL32(30, 33, 39, 242), line = IM_COL32(60, 65, 75, 255);
}  // namespace look

/// Sets colors and sizes of Dear ImGui's context.
void setStyle(double scale);

/// Draws into the current window of Dear ImGui, at a scale, and records each widget's position by its name.
class Widgets {
 public:
  explicit Widgets(double scale) : scale_(static_cast<float>(scale)) {}

  /// Positions of what was drawn, and the windows that block the pointer from what is below them.
  WidgetPlacements placements;
  std::vector<Placement> covered;
  bool closes_list = false;  ///< closes the open list

  /// Converts a length in units (pixels of a usual screen) to pixels of this one.
  [[nodiscard]] float px(float units) const;
  void note(std::string_view name);  ///< records the item drawn last
  void cover();                      ///< makes the current window block the pointer

  /// Draws a heading that opens and closes the group below; `summary`, on its right, is always visible.
  /// Returns whether it is open.
  bool group(const char* name, std::string_view summary = "");
  void row(const char* label);
  /// Draws text in a row; if too long, it ends in three dots and the tooltip shows all of it.
  void value(std::string_view text, ImU32 color = look::text);
  static void dim(std::string_view text);
  /// Draws the background of a chart and returns its top left corner.
  static ImVec2 chart(float width, float height);
  /// Shows a tooltip while the pointer rests on the previous item.
  void tooltip(std::string_view text) const;

  // Widgets that are pressed or changed return whether they were; `width` is in pixels.

  bool button(std::string_view name, const char* label, float width, bool enabled = true);
  /// A button that stays lit while `on`.
  bool chip(std::string_view name, const char* label, float width, bool on, bool enabled = true);
  void toggle(const char* name, float width, bool& on, bool enabled = true);
  /// Draws buttons side by side, one of them lit, in `width` pixels or the available width. Returns the index
  /// of the pressed one, or -1.
  int choice(std::string_view name, std::span<const std::string> labels, int current, bool enabled = true,
             float width = 0);
  /// A row with a slider as wide as there is room.
  bool slider(const char* label, std::string_view name, double& value, double least, double most,
              const char* format);
  /// Begins a drop-down list that shows `preview` when closed. If it returns true, draw its items, then call
  /// endList().
  bool beginList(std::string_view name, const char* preview);
  void endList();
  bool item(std::string_view name, const char* label, bool current, bool enabled = true);

  /// Returns the width of each of `count` items that fill the rest of a row.
  [[nodiscard]] static float share(int count);

 private:
  bool pressable(std::string_view name, const char* label, ImVec2 size, bool on, bool enabled,
                 ImDrawFlags corners);
  float scale_;
};

inline std::string fileName(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

/// A frame of the panel, as it is being drawn.
struct PanelFrame {
  const PanelInput& input;
  PanelResult& result;
  Widgets& widgets;
};

void drawActions(PanelFrame& frame);  ///< buttons for actions and saving
void drawCell(PanelFrame& frame);     ///< the cell under the pointer
void drawShow(PanelFrame& frame);     ///< the marks of the picture
void drawColor(PanelFrame& frame);    ///< the coloring
/// `energies` are those of the steps so far, relative to the hexagonal lattice's.
void drawRelax(PanelFrame& frame, const std::vector<float>& energies);
void drawFluid(PanelFrame& frame);   ///< the fluid, or buttons that begin one
void drawDevice(PanelFrame& frame);  ///< the backend and device
void drawTimes(PanelFrame& frame);   ///< the times of frames

/// Returns the horizontal range of the window that the panel leaves free, on its wider side.
std::pair<float, float> freeOf(const PanelFrame& frame);
void drawTip(PanelFrame& frame);          ///< the cell under the pointer, beside it
void drawHelp(PanelFrame& frame);         ///< the list of keys, in the middle of the window
void drawSplit(const PanelFrame& frame);  ///< the line between the pictures of two backends
void drawBrush(const PanelFrame& frame);  ///< the circle that stirs a fluid
/// `shows` is its opacity.
void drawMessage(PanelFrame& frame, const std::string& message, float shows);
/// A line around the cell under the pointer.
void drawBorder(const PanelFrame& frame);  ///< at the bottom of the window

}  // namespace vorpipe::view
