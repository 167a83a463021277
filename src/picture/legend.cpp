#include "picture/legend.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "picture/legend_contents.h"
#include "picture/pixels.h"

namespace vorpipe::core {
namespace {

constexpr std::uint32_t panel_color = 0xE0FFFFFFu;

/// Pixels per unit, and the bar's height in pixels.
struct Scale {
  int unit, bar;
};

/// The legend covers less than this in each direction, if it
/// is legible then.
Scale scaleFor(const LegendContents& contents, int width, int height) {
  constexpr double most = 0.6;
  int unit = legendUnit({width, height});
  const auto fits = [&](int units, int side) { return (units + legend_margin) * unit <= most * side; };
  const int bar = contents.barUnits();
  while (unit > 1 && !(fits(contents.width(), width) && fits(contents.height() + bar, height))) --unit;
  if (unit > 1 || bar == 0) return {unit, bar * unit};
  const int highest = std::max(static_cast<int>(most * height), least_with_legend.height) - 2 * legend_margin;
  return {1, std::clamp(std::min(highest, height - 2 * legend_margin) - contents.height(), 1, bar_height)};
}

}  // namespace

int legendUnit(PictureSize picture) {
  constexpr double pictures_side = 450;
  const double side = std::sqrt(static_cast<double>(picture.width) * picture.height);
  return std::max(1, static_cast<int>(std::lround(side / pictures_side)));
}

void drawLegend(const Legend& legend, Image& image) {
  for (const LegendBox& box : legend.boxes) {
    blendBox({box.left, box.top, box.left + box.width, box.top + box.height}, box.rgba, image);
  }
  for (const LegendText& text : legend.texts) drawText(text, image);
}

}  // namespace vorpipe::core

namespace vorpipe {

using namespace core;

Legend legendOf(const ColorKey& key, const RenderOptions& options) {
  const int width = options.width, height = options.height;
  const Palette palette = paletteFor(options, key);
  LegendContents contents = contentsOf(key, options, width);
  const int room = width - 2 * legend_margin - 2 * legend_padding;
  for (std::string& line : contents.title) line = shortened(std::move(line), room);
  LegendContents in_one_line = contents;
  in_one_line.title = {fmt::format("{}", fmt::join(contents.title, ", "))};
  if (in_one_line.width() + 2 * legend_margin <= width) contents = std::move(in_one_line);
  // What is left of the height for rows beside the shortest bar.
  const int shortest_bar = contents.labels.empty() ? 0 : 2 * label_distance;
  const int rest =
      height - 2 * legend_margin - contents.height() - shortest_bar - (shortest_bar > 0 ? rows_gap : 0);
  contents.rows = rowsOf(key, palette, static_cast<std::size_t>(std::max(0, rest / row_height)),
                         room - bar_width - label_gap);
  const auto [unit, bar_pixels] = scaleFor(contents, width, height);
  dropCrowded(contents.labels, static_cast<double>(bar_pixels) / unit);

  Legend legend;
  const double panel_width = contents.width() * unit, panel_height = contents.height() * unit + bar_pixels;
  const double left = legend_margin * unit, top = height - legend_margin * unit - panel_height;
  legend.boxes.push_back({left, top, panel_width, panel_height, panel_color});
  addContents(legend, contents, {left, top, unit, bar_pixels, black}, key, palette);
  return legend;
}

}  // namespace vorpipe
