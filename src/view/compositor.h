/// Composes a viewer's pictures and the panel in the window.
#pragma once

#include <cstdint>
#include <string>

#include "view/panel.h"
#include "view/viewer.h"
#include "view/window/window.h"

namespace vorpipe::view {

class Compositor {
 public:
  Compositor(Screen& screen, Viewer& viewer) : screen_(screen), viewer_(viewer) {}

  /// Shows the present picture and panel unless unchanged, and passes the panel's changes to the viewer. Does
  /// nothing while the window is minimized.
  Result<void> draw();
  /// Makes the next draw() show everything again: the desktop may have lost the window's contents.
  void forget() { width_ = 0; }
  /// Returns what the window shows, with or without the panel.
  Result<Image> read(bool with_panel);
  bool keeps(const Event& event) { return panel_.take(event); }
  [[nodiscard]] const Panel& panel() const { return panel_; }

 private:
  Result<void> show(const PanelTriangles* triangles);

  Screen& screen_;
  Viewer& viewer_;
  Panel panel_{};
  PanelTriangles triangles_{};
  Shown shown_{};  ///< shown last, with triangles_, in a window of this size
  int width_ = 0, height_ = 0;
  bool has_texture_ = false;
  double present_milliseconds_ = 0;
};

}  // namespace vorpipe::view
