/// Effects of the pointer in the window: it pans and zooms, adds, drags and removes sites, changes weights,
/// stirs fluids.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "view/camera.h"
#include "view/document.h"
#include "view/window/event.h"
#include "vorpipe/picture.h"

namespace vorpipe::view {

/// What an event has changed.
enum class Changed : std::uint8_t {
  nothing,
  view,     ///< the part of the plane that is shown
  drag,     ///< a site, by a drag that may continue
  sites,    ///< sites, once
  stroke,   ///< the pointer was dragged through a fluid: see Pointer::stroke()
  refused,  ///< nothing: the sites of a fluid cannot be edited
};

/// Returns the site nearest to a position if it lies within a few pixels, times `scale`; else no_site.
std::uint32_t siteNear(const Document& document, const Camera& camera, Position position, double scale = 1);

class Pointer {
 public:
  /// `owner` is the site of the cell under the pointer, or no_site.
  Changed take(const Event& event, Document& document, Camera& camera, std::uint32_t owner);

  /// Multiplies the pointer's reach in pixels, for screens with small pixels.
  void setScale(double scale) { scale_ = scale; }
  /// Its last position; none before its first event.
  [[nodiscard]] const std::optional<Position>& position() const { return position_; }
  [[nodiscard]] bool holdsSite() const { return held_ == Held::site && travelled_; }
  /// Start and end of its last drag, in the plane.
  [[nodiscard]] std::pair<Point, Point> stroke() const { return stroke_; }
  /// Ends a drag: something else has changed the sites.
  void release() { held_ = Held::nothing; }

 private:
  enum class Held : std::uint8_t { nothing, site, view, fluid };

  Changed press(const Press& press, Document& document, const Camera& camera, std::uint32_t owner);
  Changed move(Position to, Document& document, Camera& camera);
  Changed release(Button button, Document& document, const Camera& camera);
  Changed scroll(const Scroll& scroll, Document& document, Camera& camera, std::uint32_t owner);

  std::optional<Position> position_{};
  double scale_ = 1;
  Held held_ = Held::nothing;
  Button button_ = Button::left;
  Position pressed_{};      ///< where the button went down
  bool travelled_ = false;  ///< too far since the press to be a click
  std::uint32_t site_ = no_site;
  Position grip_{};  ///< offset of the site from the pointer
  std::pair<Point, Point> stroke_{};
};

/// Pictures of two backends side by side, divided by a line that can be dragged.
class SplitView {
 public:
  /// Whether it consumes the event: a press near the line, and all that follows until the release. `at` is
  /// the line's position as a fraction of the window's width; `reach` is in pixels.
  bool take(const Event& event, std::optional<Position> pointer, int width, double reach, double& at);
  void release() { held_ = false; }

  /// Returns the first picture with the other one from `column` on.
  const Image& join(const Image& first, const Image& other, int column);

 private:
  bool held_ = false;
  Image joined_{};
};

}  // namespace vorpipe::view
