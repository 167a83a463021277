#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "picture/font.h"
#include "picture/legend.h"
#include "picture/legend_contents.h"
#include "picture/pixels.h"
#include "vorpipe.h"

namespace vorpipe {

using namespace core;

namespace {

/// Breaks a text into lines of at most `most` units, between words where it can.
std::vector<std::string> linesOf(std::string_view text, int most) {
  std::vector<std::string> lines;
  std::string line;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string word = shortened(std::string(text.substr(0, end)), most);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.empty() && unitsOf(fmt::format("{} {}", line, word)) > most) {
      lines.push_back(std::exchange(line, {}));
    }
    if (!line.empty()) line += ' ';
    line += word;
  }
  if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

/// Lays the legend out right of a picture.
void addBeside(Sheet& sheet, const ColorKey& key, const RenderOptions& options, int unit, std::uint32_t ink) {
  constexpr int widest = 240, rows_without_end = 1000;
  const Palette palette = paletteFor(options, key);
  LegendContents contents = contentsOf(key, options, widest);
  std::vector<std::string> title;
  for (const std::string& line : contents.title)
    std::ranges::move(linesOf(line, widest), std::back_inserter(title));
  contents.title = std::move(title);
  contents.rows = rowsOf(key, palette, rows_without_end, widest);
  const auto heightAt = [&](int size) { return (contents.height() + contents.barUnits()) * size; };
  while (unit > 1 && heightAt(unit) > options.height) --unit;
  dropCrowded(contents.labels, contents.barUnits());
  const double left = options.width + legend_margin * unit;
  // The text begins at the picture's upper edge.
  addContents(sheet.legend, contents,
              {left, static_cast<double>(-legend_padding * unit), unit, contents.barUnits() * unit, ink}, key,
              palette);
  sheet.right += (legend_margin + contents.width()) * unit;
  sheet.bottom += std::max(0, heightAt(unit) - 2 * legend_padding * unit - options.height);
}

}  // namespace

Sheet sheetOf(const RenderOptions& options, const std::optional<ColorKey>& key) {
  const bool beside = options.legend && options.legend_beside && key;
  if (options.title.empty() && !beside) return {};
  const int unit = legendUnit({options.width, options.height});
  const std::uint32_t paper = options.background ? options.background->rgba : white, ink = inkOn(paper);
  const int border = legend_padding * unit;
  Sheet sheet{border, border, border, border};
  if (beside) addBeside(sheet, *key, options, unit, ink);
  if (!options.title.empty()) {
    // Half as high again as the legend's.
    const int size = std::max(unit + 1, 3 * unit / 2), pitch = legend_line * size;
    const auto lines = linesOf(options.title, (options.width + sheet.right - border) / size);
    sheet.top += static_cast<int>(lines.size()) * pitch;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const double baseline = border - sheet.top + static_cast<double>(k) * pitch + letter_units * size;
      sheet.legend.texts.push_back(
          {0, baseline, static_cast<double>(letter_units) * size, Anchor::start, lines[k], ink});
    }
  }
  const double width = options.width, height = options.height, all = sheet.left + width + sheet.right;
  sheet.legend.boxes.insert(
      sheet.legend.boxes.begin(),
      {LegendBox{-static_cast<double>(sheet.left), -static_cast<double>(sheet.top), all,
                 static_cast<double>(sheet.top), paper},
       LegendBox{-static_cast<double>(sheet.left), 0, static_cast<double>(sheet.left), height, paper},
       LegendBox{width, 0, static_cast<double>(sheet.right), height, paper},
       LegendBox{-static_cast<double>(sheet.left), height, all, static_cast<double>(sheet.bottom), paper}});
  return sheet;
}

std::optional<PaperSize> paperOf(const RenderOptions& options, const Sheet& sheet) {
  if (!options.paper || sheet.legend.boxes.empty()) return options.paper;
  const auto grown = [](double side, int pixels, int more) { return side * (pixels + more) / pixels; };
  return PaperSize{grown(options.paper->width, options.width, sheet.left + sheet.right),
                   grown(options.paper->height, options.height, sheet.top + sheet.bottom)};
}

Image onSheet(const Image& picture, const Sheet& sheet) {
  Image whole = picture;
  putIntoFrame({sheet.left, sheet.top, picture.width, picture.height},
               sheet.left + picture.width + sheet.right, sheet.top + picture.height + sheet.bottom, whole);
  whole.ids = {};
  Legend moved = sheet.legend;
  for (LegendBox& box : moved.boxes) {
    box.left += sheet.left;
    box.top += sheet.top;
  }
  for (LegendText& text : moved.texts) {
    text.x += sheet.left;
    text.baseline += sheet.top;
  }
  drawLegend(moved, whole);
  return whole;
}

}  // namespace vorpipe
