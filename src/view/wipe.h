/// Two pictures side by side, of which a line that is dragged shows more or less: what two backends draw.
#pragma once

#include <optional>

#include "view/window/event.h"
#include "view/window/presenter.h"
#include "vorpipe/picture.h"

namespace vorpipe::view {

class Wipe {
 public:
  /// Whether it keeps the event: a press near the line, `at` of the window's width, and what follows it until
  /// it is let go. `reach` is in pixels.
  bool take(const Event& event, std::optional<Place> pointer, int width, double reach, double& at);
  void release() { held_ = false; }

  /// The first picture, and the other one from a column on.
  const Image& put(const Image& first, const Image& other, int column);

 private:
  bool held_ = false;
  Image put_{};
};

}  // namespace vorpipe::view
