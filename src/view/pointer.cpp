#include "view/pointer.h"

#include <cmath>
#include <limits>

namespace vorpipe::view {
namespace {

/// Distance in pixels within which the pointer grabs a site.
constexpr double reach = 6;
/// Pixels that the pointer may move during a click.
constexpr double click_travel = 3;
/// Magnification by one step of the wheel.
constexpr double zoom_step = 1.2;
/// What a step of the wheel adds to a weight, in mean cell areas: edges to equal cells move by a twentieth of
/// the spacing.
constexpr double weight_step = 0.1;

/// Returns the smallest value of `difference` modulo `period`; unchanged if there is no period.
double leastImage(double difference, double period) {
  return period > 0 ? std::remainder(difference, period) : difference;
}

}  // namespace

std::uint32_t siteNear(const Document& document, const Camera& camera, Place place, double scale) {
  const Sites& sites = *document.sites();
  const Opened& opened = document.opened();
  const bool in_x = opened.periodic == Periodic::x || opened.periodic == Periodic::xy;
  const bool in_y = opened.periodic == Periodic::y || opened.periodic == Periodic::xy;
  const double width = in_x ? opened.domain.xmax - opened.domain.xmin : 0;
  const double height = in_y ? opened.domain.ymax - opened.domain.ymin : 0;
  const Point at = camera.pointAt(place);
  const double farthest = reach * scale * camera.unitsPerPixel();
  double least = farthest * farthest;
  std::uint32_t nearest = no_site;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double dx = leastImage(sites.x[i] - at.x, width), dy = leastImage(sites.y[i] - at.y, height);
    const double squared = dx * dx + dy * dy;
    if (squared > least) continue;
    least = squared;
    nearest = static_cast<std::uint32_t>(i);
  }
  return nearest;
}

Changed Pointer::take(const Event& event, Document& document, Camera& camera, std::uint32_t owner) {
  if (const auto* const to = std::get_if<Move>(&event)) return move(to->to, document, camera);
  if (!place_) return Changed::nothing;
  if (const auto* const down = std::get_if<Press>(&event)) return press(*down, document, camera, owner);
  if (const auto* const up = std::get_if<Release>(&event)) return release(up->button, document, camera);
  if (const auto* const by = std::get_if<Scroll>(&event)) return scroll(*by, document, camera, owner);
  return Changed::nothing;
}

Changed Pointer::press(const Press& press, Document& document, const Camera& camera, std::uint32_t owner) {
  if (held_ != Held::nothing) return Changed::nothing;
  if (document.fluid()) {
    if (press.button == Button::right) return Changed::refused;
    button_ = press.button;
    pressed_ = *place_;
    travelled_ = false;
    held_ = press.button == Button::left ? Held::fluid : Held::view;
    return Changed::nothing;
  }
  const std::uint32_t near = siteNear(document, camera, *place_, scale_);
  if (press.button == Button::right) {
    const std::uint32_t site = near != no_site ? near : owner;
    if (site == no_site || site >= document.sites()->size()) return Changed::nothing;
    document.remove(site);
    return Changed::sites;
  }
  button_ = press.button;
  pressed_ = *place_;
  travelled_ = false;
  site_ = press.button == Button::left ? near : no_site;
  held_ = site_ != no_site ? Held::site : Held::view;
  if (held_ == Held::site) {
    const Place stands = camera.placeOf(document.inDomain(document.place(site_)));
    grip_ = {stands.x - place_->x, stands.y - place_->y};
  }
  return Changed::nothing;
}

Changed Pointer::move(Place to, Document& document, Camera& camera) {
  const Place from = place_.value_or(to);
  place_ = to;
  if (held_ == Held::nothing) return Changed::nothing;
  if (held_ == Held::fluid) {
    stroke_ = {camera.pointAt(from), camera.pointAt(to)};
    return Changed::stroke;
  }
  const bool started = travelled_;
  travelled_ = travelled_ || std::hypot(to.x - pressed_.x, to.y - pressed_.y) > click_travel * scale_;
  if (!travelled_) return Changed::nothing;
  if (held_ == Held::view) {
    const Place since = started ? from : pressed_;
    camera.pan(to.x - since.x, to.y - since.y);
    return Changed::view;
  }
  if (site_ >= document.sites()->size()) return Changed::nothing;
  document.move(site_, document.inDomain(camera.pointAt({to.x + grip_.x, to.y + grip_.y})));
  return Changed::drag;
}

Changed Pointer::release(Button button, Document& document, const Camera& camera) {
  if (held_ == Held::nothing || button != button_) return Changed::nothing;
  const Held held = held_;
  held_ = Held::nothing;
  if (document.fluid()) return Changed::nothing;
  if (held == Held::site) {
    document.settle();
    return travelled_ ? Changed::sites : Changed::nothing;
  }
  const Point at = document.inDomain(camera.pointAt(pressed_));
  if (travelled_ || button != Button::left || !document.isInDomain(at)) return Changed::nothing;
  document.add(at);
  return Changed::sites;
}

Changed Pointer::scroll(const Scroll& scroll, Document& document, Camera& camera, std::uint32_t owner) {
  if (scroll.by == 0) return Changed::nothing;
  if (!scroll.with.control) {
    camera.zoom(*place_, std::pow(zoom_step, scroll.by));
    return Changed::view;
  }
  if (document.fluid()) return Changed::refused;
  const std::uint32_t near = siteNear(document, camera, *place_, scale_);
  const std::uint32_t site = owner != no_site ? owner : near;
  if (site == no_site || site >= document.sites()->size()) return Changed::nothing;
  const Box& box = document.opened().domain;
  const double mean_cell =
      (box.xmax - box.xmin) * (box.ymax - box.ymin) / static_cast<double>(document.sites()->size());
  document.addWeight(site, weight_step * scroll.by * mean_cell);
  return Changed::drag;
}

}  // namespace vorpipe::view
