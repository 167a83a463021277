#include "view/compositor.h"

#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"

namespace vorpipe::view {

Result<void> Compositor::show(const PanelTriangles* triangles) {
  shown_ = viewer_.shown();
  shown_.panel = triangles;
  width_ = screen_.width();
  height_ = screen_.height();
  return screen_.presenter().show(shown_, width_, height_);
}

Result<void> Compositor::draw() {
  if (screen_.width() <= 0 || screen_.height() <= 0) return {};
  viewer_.setScale(screen_.scale());
  PanelTriangles triangles;
  const PanelResult result =
      panel_.draw(viewer_.panelInput(screen_.presenter().name(), present_milliseconds_), triangles);
  viewer_.change(result.settings);
  if (result.covers) viewer_.setCovered(result.covers->first, result.covers->second);
  for (const Action action : result.actions) viewer_.act(action);
  if (result.flows_by) viewer_.flowBy(*result.flows_by);
  if (result.begins) viewer_.beginFluid(*result.begins);
  const bool new_texture = result.new_texture || !has_texture_;
  if (new_texture) {
    VORPIPE_TRY(screen_.presenter().setTexture(panel_.texture()));
    has_texture_ = true;
  }
  const bool same_window = width_ == screen_.width() && height_ == screen_.height();
  const Shown next = viewer_.shown();
  const bool same_picture = next.version == shown_.version && next.placement == shown_.placement;
  if (same_window && !new_texture && same_picture && triangles == triangles_) return {};
  triangles_ = std::move(triangles);
  const Stopwatch watch;
  auto shown = show(&triangles_);
  present_milliseconds_ = watch.milliseconds();
  return shown;
}

Result<Image> Compositor::read(bool with_panel) {
  if (with_panel) return screen_.presenter().read();
  VORPIPE_TRY(show(nullptr));
  auto image = screen_.presenter().read();
  VORPIPE_TRY(show(&triangles_));
  return image;
}

}  // namespace vorpipe::view
