/// Pictures of two backends side by side, divided by a line that can be dragged.
#pragma once

#include <optional>

#include "view/window/event.h"
#include "view/window/presenter.h"
#include "vorpipe/picture.h"

namespace vorpipe::view {

class Wipe {
 public:
  /// Whether it consumes the event: a press near the line, and all that follows until the release. `at` is
  /// the line's position as a fraction of the window's width; `reach` is in pixels.
  bool take(const Event& event, std::optional<Place> pointer, int width, double reach, double& at);
  void release() { held_ = false; }

  /// Returns the first picture with the other one from `column` on.
  const Image& put(const Image& first, const Image& other, int column);

 private:
  bool held_ = false;
  Image put_{};
};

}  // namespace vorpipe::view
