#include "view/wipe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vorpipe::view {

bool Wipe::take(const Event& event, std::optional<Place> pointer, int width, double reach, double& at) {
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

const Image& Wipe::put(const Image& first, const Image& other, int column) {
  put_.width = first.width;
  put_.height = first.height;
  put_.rgba = first.rgba;
  const auto width = static_cast<std::size_t>(first.width);
  const auto from = static_cast<std::size_t>(std::clamp(column, 0, first.width));
  for (std::size_t row = 0; row < static_cast<std::size_t>(first.height); ++row) {
    const auto begin = other.rgba.begin() + static_cast<std::ptrdiff_t>(row * width);
    std::copy(begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(width),
              put_.rgba.begin() + static_cast<std::ptrdiff_t>(row * width + from));
  }
  return put_;
}

}  // namespace vorpipe::view
