#include "view/pointer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

}  // namespace

std::uint32_t siteNear(const Document& document, const Camera& camera, Position position, double scale) {
  const Sites& sites = *document.sites();
  const Opened& opened = document.opened();
  const Point period = periodsOf(opened.domain, opened.periodic);
  const Point at = camera.pointAt(position);
  const double farthest = reach * scale * camera.unitsPerPixel();
  double least = farthest * farthest;
  std::uint32_t nearest = no_site;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double dx = leastImage(sites.x[i] - at.x, period.x), dy = leastImage(sites.y[i] - at.y, period.y);
    const double squared = dx * dx + dy * dy;
    if (squared > least) continue;
    least = squared;
    nearest = static_cast<std::uint32_t>(i);
  }
  return nearest;
}

Changed Pointer::take(const Event& event, Document& document, Camera& camera, std::uint32_t owner) {
  if (const auto* const to = std::get_if<Move>(&event)) return move(to->to, document, camera);
  if (!position_) return Changed::nothing;
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
    pressed_ = *position_;
    travelled_ = false;
    held_ = press.button == Button::left ? Held::fluid : Held::view;
    return Changed::nothing;
  }
  const std::uint32_t near = siteNear(document, camera, *position_, scale_);
  if (press.button == Button::right) {
    const std::uint32_t site = near != no_site ? near : owner;
    if (site == no_site || site >= document.sites()->size()) return Changed::nothing;
    document.remove(site);
    return Changed::sites;
  }
  button_ = press.button;
  pressed_ = *position_;
  travelled_ = false;
  site_ = press.button == Button::left ? near : no_site;
  held_ = site_ != no_site ? Held::site : Held::view;
  if (held_ == Held::site) {
    const Position stands = camera.positionOf(document.inDomain(document.position(site_)));
    grip_ = {stands.x - position_->x, stands.y - position_->y};
  }
  return Changed::nothing;
}

Changed Pointer::move(Position to, Document& document, Camera& camera) {
  const Position from = position_.value_or(to);
  position_ = to;
  if (held_ == Held::nothing) return Changed::nothing;
  if (held_ == Held::fluid) {
    stroke_ = {camera.pointAt(from), camera.pointAt(to)};
    return Changed::stroke;
  }
  const bool started = travelled_;
  travelled_ = travelled_ || std::hypot(to.x - pressed_.x, to.y - pressed_.y) > click_travel * scale_;
  if (!travelled_) return Changed::nothing;
  if (held_ == Held::view) {
    const Position since = started ? from : pressed_;
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
    camera.zoom(*position_, std::pow(zoom_step, scroll.by));
    return Changed::view;
  }
  if (document.fluid()) return Changed::refused;
  const std::uint32_t near = siteNear(document, camera, *position_, scale_);
  const std::uint32_t site = owner != no_site ? owner : near;
  if (site == no_site || site >= document.sites()->size()) return Changed::nothing;
  const Box& box = document.opened().domain;
  const double mean_cell =
      (box.xmax - box.xmin) * (box.ymax - box.ymin) / static_cast<double>(document.sites()->size());
  document.addWeight(site, weight_step * scroll.by * mean_cell);
  return Changed::drag;
}

bool SplitView::take(const Event& event, std::optional<Position> pointer, int width, double reach,
                     double& at) {
  if (const auto* const move = std::get_if<Move>(&event)) {
    if (held_) at = std::clamp(move->to.x / width, 0.0, 1.0);
    return held_;
  }
  if (const auto* const press = std::get_if<Press>(&event)) {
    if (!pointer || press->button != Button::left || std::abs(pointer->x - at * width) > reach) return false;
    return held_ = true;
  }
  const auto* const up = std::get_if<Release>(&event);
  if (!held_ || up == nullptr || up->button != Button::left) return false;
  held_ = false;
  return true;
}

const Image& SplitView::join(const Image& first, const Image& other, int column) {
  joined_.width = first.width;
  joined_.height = first.height;
  joined_.rgba = first.rgba;
  const auto width = static_cast<std::size_t>(first.width);
  const auto from = static_cast<std::size_t>(std::clamp(column, 0, first.width));
  for (std::size_t row = 0; row < static_cast<std::size_t>(first.height); ++row) {
    const auto begin = other.rgba.begin() + static_cast<std::ptrdiff_t>(row * width);
    std::copy(begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(width),
              joined_.rgba.begin() + static_cast<std::ptrdiff_t>(row * width + from));
  }
  return joined_;
}

}  // namespace vorpipe::view
