#include "view/stage.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"

namespace vorpipe::view {
namespace {

auto tied(const PanelVertex& v) { return std::tie(v.x, v.y, v.u, v.v, v.rgba); }
auto tied(const PanelPart& p) { return std::tie(p.first_index, p.indices, p.left, p.top, p.right, p.bottom); }
auto tied(const Shown& s) {
  const Placement& p = s.placement;
  return std::tie(s.version, p.left, p.top, p.width, p.height);
}

bool isSame(const PanelTriangles& a, const PanelTriangles& b) {
  const auto same = [](const auto& one, const auto& other) { return tied(one) == tied(other); };
  return std::ranges::equal(a.parts, b.parts, same) && a.indices == b.indices &&
         std::ranges::equal(a.vertices, b.vertices, same);
}

}  // namespace

Result<void> Stage::show(const PanelTriangles* triangles) {
  shown_ = viewer_.shown();
  shown_.panel = triangles;
  width_ = screen_.width();
  height_ = screen_.height();
  return screen_.presenter().show(shown_, width_, height_);
}

Result<void> Stage::draw() {
  if (screen_.width() <= 0 || screen_.height() <= 0) return {};
  viewer_.setScale(screen_.scale());
  PanelTriangles triangles;
  const PanelAnswer answer =
      panel_.draw(viewer_.panelInput(screen_.presenter().name(), present_milliseconds_), triangles);
  viewer_.change(answer.settings);
  if (answer.covers) viewer_.setCovered(answer.covers->first, answer.covers->second);
  for (const Action action : answer.actions) viewer_.act(action);
  if (answer.flows_by) viewer_.flowBy(*answer.flows_by);
  if (answer.begins) viewer_.beginFluid(*answer.begins);
  const bool new_texture = answer.new_texture || !has_texture_;
  if (new_texture) {
    VORPIPE_TRY(screen_.presenter().setTexture(panel_.texture()));
    has_texture_ = true;
  }
  const bool same_window = width_ == screen_.width() && height_ == screen_.height();
  if (same_window && !new_texture && tied(shown_) == tied(viewer_.shown()) && isSame(triangles, triangles_)) {
    return {};
  }
  triangles_ = std::move(triangles);
  const Stopwatch watch;
  auto shown = show(&triangles_);
  present_milliseconds_ = watch.milliseconds();
  return shown;
}

Result<Image> Stage::read(bool with_panel) {
  if (with_panel) return screen_.presenter().read();
  VORPIPE_TRY(show(nullptr));
  auto image = screen_.presenter().read();
  VORPIPE_TRY(show(&triangles_));
  return image;
}

}  // namespace vorpipe::view
