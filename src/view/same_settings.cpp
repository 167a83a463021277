#include "view/same_settings.h"

#include <tuple>

namespace vorpipe::view {
namespace {

auto colorsOf(const RenderOptions& p) {
  return std::tie(p.color, p.colormap, p.color_scale, p.legend, p.fill, p.antialias);
}

auto marksOf(const RenderOptions& p) {
  return std::tie(p.edges, p.edge_width, p.show_sites, p.dot_size, p.dual, p.labels, p.label_size);
}

bool isSame(const std::optional<ColorRange>& a, const std::optional<ColorRange>& b) {
  return a.has_value() == b.has_value() && (!a || (a->low == b->low && a->high == b->high));
}

auto tied(const BackendOptions& b) {
  return std::tie(b.name, b.device, b.threads, b.mask.disabled, b.mask.limits, b.validation);
}

bool isSame(const std::optional<BackendOptions>& a, const std::optional<BackendOptions>& b) {
  return a.has_value() == b.has_value() && (!a || tied(*a) == tied(*b));
}

auto tied(const SearchOptions& s) { return std::tie(s.method, s.neighbors); }

}  // namespace

bool drawTheSame(const Settings& a, const Settings& b) {
  return a.cells == b.cells && a.flow_color == b.flow_color && tied(a.backend) == tied(b.backend) &&
         isSame(a.compared, b.compared) && colorsOf(a.picture) == colorsOf(b.picture) &&
         marksOf(a.picture) == marksOf(b.picture) && isSame(a.picture.color_range, b.picture.color_range) &&
         tied(a.picture.search) == tied(b.picture.search);
}

}  // namespace vorpipe::view
