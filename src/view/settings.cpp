#include "view/settings.h"

#include <optional>
#include <tuple>
#include <utility>

#include "base/option_rows.h"

namespace vorpipe::view {
namespace {

auto tied(const RenderOptions& p) {
  return std::apply(
      [&](const auto&... row) {
        return std::tie(p.color, p.colormap, p.colors, p.color_scale, p.legend, p.fill, p.search.method,
                        p.search.neighbors, (p.*row.member)...);
      },
      picture_rows);
}

auto tied(const ColorRange& r) { return std::tie(r.low, r.high); }

auto tied(const BackendOptions& b) {
  return std::tie(b.name, b.device, b.threads, b.mask.disabled, b.mask.limits, b.validation);
}

template <class T>
bool isSame(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || tied(*a) == tied(*b));
}

}  // namespace

void colorBy(ColorBy color, Settings& settings) {
  settings.flow_color = FlowColor::none;
  RenderOptions& picture = settings.picture;
  if (picture.color == color) return;
  picture.color = color;
  picture.color_scale = ColorScale::automatic;
  picture.color_range.reset();
  if (color == ColorBy::site) picture.legend = false;
}

BackendOptions comparedWith(const BackendOptions& backend, std::string name, std::string device) {
  BackendOptions other{};
  other.name = std::move(name);
  other.device = std::move(device);
  other.threads = backend.threads;
  other.validation = backend.validation;
  return other;
}

bool isSame(const BackendOptions& a, const BackendOptions& b) { return tied(a) == tied(b); }

bool drawTheSame(const Settings& a, const Settings& b) {
  return a.cells == b.cells && a.flow_color == b.flow_color && isSame(a.backend, b.backend) &&
         isSame(a.compared, b.compared) && tied(a.picture) == tied(b.picture) &&
         isSame(a.picture.color_range, b.picture.color_range);
}

}  // namespace vorpipe::view
