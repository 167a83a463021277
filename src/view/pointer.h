/// Effects of the pointer in the window: it pans and zooms, adds, drags and removes sites, changes weights,
/// stirs fluids.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "view/camera.h"
#include "view/document.h"
#include "view/window/event.h"

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

/// Returns the site nearest to a place if it lies within a few pixels, times `scale`; else no_site.
std::uint32_t siteNear(const Document& document, const Camera& camera, Place place, double scale = 1);

class Pointer {
 public:
  /// `owner` is the site of the cell under the pointer, or no_site.
  Changed take(const Event& event, Document& document, Camera& camera, std::uint32_t owner);

  /// Multiplies the pointer's reach in pixels, for screens with small pixels.
  void setScale(double scale) { scale_ = scale; }
  /// Its last place; none before its first event.
  [[nodiscard]] const std::optional<Place>& place() const { return place_; }
  [[nodiscard]] bool holdsSite() const { return held_ == Held::site && travelled_; }
  /// Start and end of its last drag, in the plane.
  [[nodiscard]] std::pair<Point, Point> stroke() const { return stroke_; }
  /// Ends a drag: something else has changed the sites.
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
  Place pressed_{};         ///< where the button went down
  bool travelled_ = false;  ///< too far since the press to be a click
  std::uint32_t site_ = no_site;
  Place grip_{};  ///< offset of the site from the pointer
  std::pair<Point, Point> stroke_{};
};

}  // namespace vorpipe::view
