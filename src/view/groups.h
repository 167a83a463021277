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

/// The tooltip beside the pointer: the cell under it.
void drawTip(PanelFrame& frame);
/// The list of keys, in the middle of the window.
void drawHelp(PanelFrame& frame);
/// The line between the pictures of two backends.
void drawWipe(const PanelFrame& frame);
/// The circle that stirs a fluid.
void drawBrush(const PanelFrame& frame);
/// The message, at the bottom of the window.
void drawMessage(PanelFrame& frame);

}  // namespace vorpipe::view
