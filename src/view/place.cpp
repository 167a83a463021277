#include "view/place.h"

#include <algorithm>
#include <cmath>

namespace vorpipe::view {

void PanelPlace::apply(ImVec2 window, float width, float margin) {
  window_ = window;
  width_ = width;
  margin_ = margin;
  // While a button is held, Dear ImGui moves the panel.
  if (began_ && ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
  const float farthest = std::max(margin, window.x - width - margin);
  if (!began_) at_ = {margin, margin};
  if (side_ == Side::left) at_.x = margin;
  if (side_ == Side::right) at_.x = farthest;
  at_.x = std::clamp(at_.x, std::min(0.0F, farthest), std::max(farthest, 0.0F));
  at_.y = std::clamp(at_.y, 0.0F, std::max(margin, window.y / 2));
  ImGui::SetNextWindowPos({std::round(at_.x), std::round(at_.y)}, ImGuiCond_Always);
  began_ = true;
}

void PanelPlace::follow() {
  const ImVec2 at = ImGui::GetWindowPos();
  if (at.x == std::round(at_.x) && at.y == std::round(at_.y)) return;
  at_ = at;
  const float near = 3 * margin_;
  side_ = Side::free;
  if (window_.x - at.x - width_ < near) side_ = Side::right;
  if (at.x < near) side_ = Side::left;
  if (at.y < near) at_.y = margin_;
}

}  // namespace vorpipe::view
