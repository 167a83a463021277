/// The position of the panel, and how it is moved.
#pragma once

#include <imgui.h>

namespace vorpipe::view {

/// Dragging a free part of its surface moves the panel. Released near the window's left or right edge, it
/// stays at that edge when the window is resized.
class PanelPlace {
 public:
  /// Call before the panel's ImGui window begins: `width` is the panel's, `margin` its distance from the
  /// window's edges.
  void apply(ImVec2 window, float width, float margin);
  /// Call after it began.
  void follow();
  [[nodiscard]] float left() const { return at_.x; }
  [[nodiscard]] float top() const { return at_.y; }
  /// Moves the panel to the other edge.
  void swap() { side_ = side_ == Side::right ? Side::left : Side::right; }

 private:
  enum class Side { left, right, free };
  Side side_ = Side::left;
  bool began_ = false;
  ImVec2 at_{0, 0}, window_{0, 0};
  float width_ = 0, margin_ = 0;
};

}  // namespace vorpipe::view
