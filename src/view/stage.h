/// Shows a viewer's pictures and the panel in the window.
#pragma once

#include <cstdint>
#include <string>

#include "view/panel.h"
#include "view/screen.h"
#include "view/viewer.h"

namespace vorpipe::view {

class Stage {
 public:
  Stage(Screen& screen, Viewer& viewer) : screen_(screen), viewer_(viewer) {}

  /// Shows the present picture and panel unless unchanged, and passes the panel's changes to the viewer. Does
  /// nothing while the window is minimized.
  Result<void> draw();
  /// Makes the next draw() show everything again: the desktop may have lost the window's contents.
  void forget() { width_ = 0; }
  /// Returns what the window shows, with or without the panel.
  Result<Image> read(bool with_panel);
  /// Whether the panel consumes an event.
  bool keeps(const Event& event) { return panel_.take(event); }
  /// The panel as it was drawn last.
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
