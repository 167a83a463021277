/// Puts a viewer's pictures and the panel into the window.
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

  /// Shows what is there now, unless that is what was shown last, and hands the panel's changes on. Nothing
  /// where the window is minimized.
  Result<void> draw();
  /// The desktop may have lost what was shown: it is shown again with the next draw().
  void forget() { width_ = 0; }
  /// What the window shows, with or without the panel.
  Result<Image> read(bool with_panel);
  /// Whether the panel keeps an event for itself.
  bool keeps(const Event& event) { return panel_.take(event); }
  /// The panel as it stood when it was drawn last.
  [[nodiscard]] const Panel& panel() const { return panel_; }

 private:
  Result<void> show(const PanelTriangles* triangles);

  Screen& screen_;
  Viewer& viewer_;
  Panel panel_{};
  PanelTriangles triangles_{};
  Shown shown_{};  ///< last, with triangles_, in a window of this size
  int width_ = 0, height_ = 0;
  bool has_texture_ = false;
  double present_milliseconds_ = 0;
};

}  // namespace vorpipe::view
