/// Where the panel stands, and how it is moved.
#pragma once

#include <imgui.h>

namespace vorpipe::view {

/// The panel is moved by what is free of its surface. Let go near the left or the right edge of the window it
/// stays at that edge, whatever size the window has.
class PanelPlace {
 public:
  /// Before the panel's window begins: `width` is its own, `margin` what it keeps from the window's edges.
  void apply(ImVec2 window, float width, float margin);
  /// After it began.
  void follow();
  [[nodiscard]] float left() const { return at_.x; }
  [[nodiscard]] float top() const { return at_.y; }
  /// To the other edge.
  void swap() { side_ = side_ == Side::right ? Side::left : Side::right; }

 private:
  enum class Side { left, right, free };
  Side side_ = Side::left;
  bool began_ = false;
  ImVec2 at_{0, 0}, window_{0, 0};
  float width_ = 0, margin_ = 0;
};

}  // namespace vorpipe::view
