#include <fmt/format.h>

#include <algorithm>

#include "cli/comparison.h"
#include "vorpipe/legend.h"

namespace vorpipe::cli {
namespace {

/// Pixels of one unit of the font: letters are 7 units high.
int unitFor(int width) { return std::max(1, width / 500); }

/// Shortens a text until it is at most `width` pixels wide; three dots replace its end.
LegendText fitted(std::string text, double width, double height) {
  LegendText fits{0, 0, height, Anchor::start, std::move(text)};
  std::string kept = fits.text;
  while (widthOf(fits) > width && !kept.empty()) {
    // Whole letters: in UTF-8 these bytes continue one.
    while ((static_cast<unsigned char>(kept.back()) & 0xC0u) == 0x80u && kept.size() > 1) kept.pop_back();
    kept.pop_back();
    fits.text = kept + "...";
  }
  return fits;
}

/// A picture of the montage, with its heading.
struct Panel {
  std::string what, more;
  Picture picture;
};

/// Returns the panel's picture below its heading, in black on white.
Picture headed(const Panel& panel) {
  const int width = panel.picture.width, top = headingHeight(width), unit = unitFor(width);
  Image heading{width, top, {}, {}};
  heading.rgba.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(top), 0xFFFFFFFFu);
  int baseline = 12 * unit;
  for (const std::string& line : {panel.what, panel.more}) {
    LegendText text = fitted(line, width - 8.0 * unit, 7.0 * unit);
    text.x = 4.0 * unit;
    text.baseline = baseline;
    drawText(text, heading);
    baseline += 12 * unit;
  }
  Picture whole{width, top + panel.picture.height, std::move(heading.rgba)};
  whole.rgba.insert(whole.rgba.end(), panel.picture.rgba.begin(), panel.picture.rgba.end());
  return whole;
}

/// Colors, or where there are none shades of ids.
Picture shown(const Image& image) {
  if (image.rgba.empty()) return grayOfIds(image.ids, image.width, image.height);
  return {image.width, image.height, image.rgba};
}

Panel differencesOf(const Comparison& comparison, const PairDiff& pair) {
  const Image& image = comparison.runs[pair.a].rendering.image;
  Picture marked = grayOfIds(image.ids, image.width, image.height);
  markDifferences(marked, pair.pixels.pixels);
  return {fmt::format("{} / {}", comparison.nameOf(pair.a), comparison.nameOf(pair.b)),
          fmt::format("{} wrong (red), {} on edges (yellow)", pair.pixels.wrong, pair.pixels.ties),
          std::move(marked)};
}

/// Pastes panels of one size side by side.
void pasteRow(Picture& montage, const std::vector<Panel>& panels, int row) {
  int column = 0;
  for (const Panel& panel : panels) {
    paste(montage, headed(panel), row, column);
    column += panel.picture.width;
  }
}

}  // namespace

int headingHeight(int width) { return 28 * unitFor(width); }

Picture comparisonMontage(const Comparison& comparison) {
  const Image& image = comparison.runs.front().rendering.image;
  std::vector<Panel> pictures, differences;
  for (const BackendRun& run : comparison.runs) {
    pictures.push_back({run.name, run.rendering.report.device, shown(run.rendering.image)});
  }
  if (comparison.reference) {
    pictures.push_back({comparison.reference->path, "the reference", shown(comparison.reference->image)});
  }
  for (const PairDiff& pair : comparison.pairs) differences.push_back(differencesOf(comparison, pair));
  const auto columns = static_cast<int>(std::max(pictures.size(), differences.size()));
  const int height = headingHeight(image.width) + image.height;
  Picture montage{columns * image.width, 2 * height, {}};
  montage.rgba.resize(static_cast<std::size_t>(montage.width) * static_cast<std::size_t>(montage.height),
                      0xFFFFFFFFu);
  pasteRow(montage, pictures, 0);
  pasteRow(montage, differences, height);
  return montage;
}

}  // namespace vorpipe::cli
