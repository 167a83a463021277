/// What the pointer does in the window: it pans and zooms, adds, drags and removes sites, changes weights,
/// stirs fluids.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "view/camera.h"
#include "view/document.h"
#include "view/window/event.h"

namespace vorpipe::view {

/// What has changed by an event.
enum class Changed : std::uint8_t {
  nothing,
  view,     ///< what of the plane is shown
  drag,     ///< a site, and it may go on
  sites,    ///< sites, once
  stroke,   ///< the pointer was dragged through a fluid: see Pointer::stroke()
  refused,  ///< nothing, since sites of a fluid are not edited
};

/// The site nearest to a place, if it is some pixels away at most, times `scale`; else no_site.
std::uint32_t siteNear(const Document& document, const Camera& camera, Place place, double scale = 1);

class Pointer {
 public:
  /// `owner` is the site of the cell under the pointer, or no_site.
  Changed take(const Event& event, Document& document, Camera& camera, std::uint32_t owner);

  /// As many times as far does it reach: where pixels are small.
  void setScale(double scale) { scale_ = scale; }
  /// Where it was last; none before it came.
  [[nodiscard]] const std::optional<Place>& place() const { return place_; }
  [[nodiscard]] bool holdsSite() const { return held_ == Held::site && travelled_; }
  /// From where to where in the plane it was dragged last.
  [[nodiscard]] std::pair<Point, Point> stroke() const { return stroke_; }
  /// Lets go of what it holds: sites have changed by something else.
  void release() { held_ = Held::nothing; }

 private:
  enum class Held : std::uint8_t { nothing, site, view, fluid };

  Changed press(const Press& press, Document& document, const Camera& camera, std::uint32_t owner);
  Changed move(Place to, Document& document, Camera& camera);
  Changed release(Button button, Document& document, const Camera& camera);
  Changed scroll(const Scroll& scroll, Document& document, Camera& camera, std::uint32_t owner);

  std::optional<Place> place_{};
  double scale_ = 1;
  Held held_ = Held::nothing;
  Button button_ = Button::left;
  Place pressed_{};         ///< where
  bool travelled_ = false;  ///< so far since it was pressed that it is no click
  std::uint32_t site_ = no_site;
  Place grip_{};  ///< of the site, from the pointer
  std::pair<Point, Point> stroke_{};
};

}  // namespace vorpipe::view
