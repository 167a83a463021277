#include "view/app/stage.h"

#include "base/stopwatch.h"

namespace vorpipe::view {

Result<void> Stage::show(const PanelTriangles* triangles) {
  Shown shown = viewer_.shown();
  shown.panel = triangles;
  return screen_.presenter().show(shown, screen_.width(), screen_.height());
}

Result<void> Stage::draw() {
  if (screen_.width() <= 0 || screen_.height() <= 0) return {};
  const PanelAnswer answer =
      panel_.draw(viewer_.panelInput(screen_.presenter().name(), present_milliseconds_), triangles_);
  viewer_.change(answer.settings);
  for (const Action action : answer.actions) viewer_.act(action);
  if (answer.new_texture || !has_texture_) {
    if (auto set = screen_.presenter().setTexture(panel_.texture()); !set) return set;
    has_texture_ = true;
  }
  const Stopwatch watch;
  auto shown = show(&triangles_);
  present_milliseconds_ = watch.milliseconds();
  return shown;
}

Result<Image> Stage::read(bool with_panel) {
  if (with_panel) return screen_.presenter().read();
  if (auto shown = show(nullptr); !shown) return tl::unexpected(std::move(shown.error()));
  auto image = screen_.presenter().read();
  if (auto shown = show(&triangles_); !shown) return tl::unexpected(std::move(shown.error()));
  return image;
}

}  // namespace vorpipe::view
