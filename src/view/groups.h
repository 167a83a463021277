/// The groups of the panel.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "view/panel.h"
#include "view/widgets.h"

namespace vorpipe::view {

/// A path without its folders.
inline std::string fileName(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

/// A frame of the panel, as it is being drawn.
struct PanelFrame {
  const PanelInput& input;
  PanelAnswer& answer;
  Widgets& widgets;
};

void drawActions(PanelFrame& frame);  ///< what is done at once, and saved
void drawCell(PanelFrame& frame);     ///< what is under the pointer
void drawShow(PanelFrame& frame);     ///< which marks a picture has
void drawColor(PanelFrame& frame);    ///< what colors stand for
/// `energies` are those of the steps so far, over the hexagonal lattice's.
void drawRelax(PanelFrame& frame, const std::vector<float>& energies);
void drawFluid(PanelFrame& frame);   ///< the fluid, or how to begin one
void drawDevice(PanelFrame& frame);  ///< what computes
void drawTimes(PanelFrame& frame);   ///< what frames take

/// What of the window's width the panel leaves free beside it, on the side where that is more.
std::pair<float, float> freeOf(const PanelFrame& frame);

/// The cell under the pointer, beside it.
void drawTip(PanelFrame& frame);
/// The keys, in the middle of the window.
void drawHelp(PanelFrame& frame);
/// The line between the pictures of two backends.
void drawWipe(const PanelFrame& frame);
/// The circle that stirs a fluid.
void drawBrush(const PanelFrame& frame);
/// The message, at the bottom of the window.
void drawMessage(PanelFrame& frame);

}  // namespace vorpipe::view
