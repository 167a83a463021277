#include "picture/legend.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <utility>

#include "base/option_names.h"
#include "picture/font.h"
#include "picture/palette.h"
#include "picture/pixels.h"
#include "vorpipe.h"

namespace vorpipe::core {
namespace {

constexpr int fewest_digits = 3, most_digits = 17;
/// Numbers from 10^least_exponent to 10^most_exponent are written without an exponent.
constexpr int least_exponent = -3, most_exponent = 6;

void dropLastZeros(std::string& digits) {
  if (digits.find('.') == std::string::npos) return;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
}

bool areDistinct(std::span<const double> numbers, std::span<const std::string> texts) {
  for (std::size_t i = 1; i < texts.size(); ++i) {
    if (numbers[i] != numbers[i - 1] && texts[i] == texts[i - 1]) return false;
  }
  return true;
}

}  // namespace

std::string numberText(double number, int digits) {
  if (number == 0) return "0";
  // Rounded first: 999.9 has the exponent of 1000.
  std::string scientific = fmt::format("{:.{}e}", number, digits - 1);
  const auto e = scientific.find('e');
  const int exponent = std::atoi(scientific.c_str() + e + 1);
  if (exponent >= least_exponent && exponent < most_exponent) {
    std::string fixed = fmt::format("{:.{}f}", number, std::max(0, digits - 1 - exponent));
    dropLastZeros(fixed);
    return fixed;
  }
  scientific.erase(e);
  dropLastZeros(scientific);
  return fmt::format("{}e{}", scientific, exponent);
}

std::vector<std::string> numberTexts(std::span<const double> numbers, std::size_t longest) {
  std::vector<std::string> texts(numbers.size());
  for (int digits = fewest_digits; digits <= most_digits; ++digits) {
    std::vector<std::string> tried(numbers.size());
    std::ranges::transform(numbers, tried.begin(), [&](double number) { return numberText(number, digits); });
    const bool fits = std::ranges::all_of(tried, [&](const auto& text) { return text.size() <= longest; });
    if (!fits && digits > fewest_digits) break;
    texts = std::move(tried);
    if (areDistinct(numbers, texts)) break;
  }
  return texts;
}

namespace {

constexpr std::uint32_t panel_color = 0xE0FFFFFFu, line_color = 0xFF303030u;

// Lengths in the units of the font.
constexpr int line_height = 11;
constexpr int margin = 3, padding = 5, title_gap = 9, bottom_gap = 3;
constexpr int bar_width = 10, bar_height = 84, tick_length = 2, label_gap = 5;
constexpr int row_height = 12, swatch_height = 9, rows_gap = 8;
constexpr int label_distance = 11;         ///< of two baselines
constexpr std::size_t longest_label = 10;  ///< fits into every picture

struct Label {
  double place;  ///< along the colors
  std::string text;
};

/// A color that stands for one thing.
struct Row {
  std::string text;
  std::optional<std::uint32_t> rgba{};  ///< none: a text alone
};

/// The texts, with sizes in units.
struct Contents {
  std::vector<std::string> title;  ///< lines
  std::vector<Label> labels{};     ///< ascending, of a bar; without them there is none
  std::vector<Row> rows{};         ///< below it

  [[nodiscard]] int width() const {
    int widest = 0;
    for (const std::string& line : title) widest = std::max(widest, unitsOf(line));
    for (const Label& label : labels) widest = std::max(widest, bar_width + label_gap + unitsOf(label.text));
    for (const Row& row : rows) widest = std::max(widest, bar_width + label_gap + unitsOf(row.text));
    return widest + 2 * padding;
  }
  /// Without the bar.
  [[nodiscard]] int height() const {
    const int lines = static_cast<int>(title.size());
    const int below =
        static_cast<int>(rows.size()) * row_height + (rows.empty() || labels.empty() ? 0 : rows_gap);
    return padding + (lines - 1) * line_height + letter_units + title_gap + bottom_gap + padding + below;
  }
  [[nodiscard]] int barUnits() const { return labels.empty() ? 0 : bar_height; }
};

std::vector<std::string> titleOf(const ColorKey& key, const RenderOptions& options) {
  std::vector<std::string> title;
  title.push_back(!options.legend_title.empty() ? options.legend_title
                  : !key.title.empty()          ? key.title
                  : key.color == ColorBy::value ? "value"
                                                : std::string(nameOf(key.color)));
  if (!key.names.empty()) return title;
  if (key.scale == ColorScale::log) title.emplace_back("log");
  if (key.scale == ColorScale::quantile) title.emplace_back("quantiles");
  return title;
}

/// The labels of the ticks of `key`, with enough digits to distinguish them, if a picture of this width has
/// room. One of equal labels stays, preferably that of an end.
std::vector<Label> labelsOf(const ColorKey& key, int width) {
  if (!key.names.empty()) return {};
  if (!(key.range.low < key.range.high)) return {{0.5, numberText(key.range.low, 6)}};
  std::vector<double> values;
  for (const auto& [place, value] : key.ticks) values.push_back(value);
  const int digit = unitsOf("00") - unitsOf("0");
  const int room = (width - 2 * (margin + padding) - bar_width - label_gap) / digit;
  auto texts = numberTexts(values, std::max(longest_label, static_cast<std::size_t>(std::max(0, room))));
  std::vector<Label> labels;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Label label{key.ticks[i].first, std::move(texts[i])};
    if (labels.empty() || labels.back().text != label.text) {
      labels.push_back(std::move(label));
    } else if (i + 1 == values.size() && labels.size() > 1) {
      labels.back() = std::move(label);
    }
  }
  return labels;
}

/// Drops labels that would be too near to others beside a bar of that height. Keeps the ends, and then labels
/// nearest to the middle.
void dropCrowded(std::vector<Label>& labels, double height) {
  std::ranges::stable_sort(labels, {}, [](const Label& label) {
    const bool is_end = label.place <= 0 || label.place >= 1;
    return is_end ? -1 : std::abs(label.place - 0.5);
  });
  std::vector<Label> kept;
  for (Label& label : labels) {
    const bool crowded = std::ranges::any_of(kept, [&](const Label& other) {
      return std::abs(label.place - other.place) * height < label_distance;
    });
    if (!crowded) kept.push_back(std::move(label));
  }
  std::ranges::sort(kept, {}, &Label::place);
  labels = std::move(kept);
}

/// Pixels per unit, and the bar's height in pixels.
struct Scale {
  int unit, bar;
};

/// Chooses about the same share of every picture. The legend covers less than this in each direction, if it
/// is legible then.
Scale scaleFor(const Contents& contents, int width, int height) {
  constexpr double pictures_side = 450, most = 0.6;
  int unit = std::max(
      1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(width) * height) / pictures_side)));
  const auto fits = [&](int units, int side) { return (units + margin) * unit <= most * side; };
  const int bar = contents.barUnits();
  while (unit > 1 && !(fits(contents.width(), width) && fits(contents.height() + bar, height))) --unit;
  if (unit > 1 || bar == 0) return {unit, bar * unit};
  const int highest = std::max(static_cast<int>(most * height), least_with_legend.height) - 2 * margin;
  return {1, std::clamp(std::min(highest, height - 2 * margin) - contents.height(), 1, bar_height)};
}

/// Cuts a text that is wider than `most` units.
std::string shortened(std::string text, int most) {
  constexpr std::string_view dots = "\u2026";
  if (unitsOf(text) <= most) return text;
  const auto isInside = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; };
  while (!text.empty() && unitsOf(text + std::string(dots)) > most) {
    while (text.size() > 1 && isInside(text.back())) text.pop_back();
    text.pop_back();
  }
  return text + std::string(dots);
}

/// Returns the rows of names and of missing values, at most `most`, whose texts have `room`.
std::vector<Row> rowsOf(const ColorKey& key, const Palette& palette, std::size_t most, int room) {
  std::size_t names = key.names.size();
  bool others = key.other_names > 0, missing = key.has_missing;
  const std::size_t after = (missing ? 1u : 0u) + (others ? 1u : 0u);
  std::uint64_t left_out = 0;
  if (names + after > most) {
    // A row says how many are left out.
    others = others && most > after;
    missing = missing && most > 1;
    names = most > after ? most - after - 1 : 0;
    left_out = key.names.size() - names + (others ? 0 : key.other_names);
  }
  std::vector<Row> rows;
  for (std::size_t k = 0; k < names; ++k) rows.push_back({shortened(key.names[k], room), palette[k]});
  if (left_out > 0 && most > 0) rows.push_back({fmt::format("and {} more", left_out)});
  if (others) rows.push_back({fmt::format("and {} others", key.other_names), palette[other_names_color]});
  if (missing) rows.push_back({"no value", palette[missing_color]});
  return rows;
}

/// Draws the colors from `bottom` upward. Each box overlaps the next, which is drawn over it, so that
/// antialiasing shows no seams.
void addBar(Legend& legend, const LegendBox& bar, const Palette& palette, bool equal) {
  const int last = static_cast<int>(palette.size()) - 1;
  const int height = static_cast<int>(bar.height);
  const int steps = equal ? 1 : std::min(static_cast<int>(palette.size()), height);
  const double bottom = bar.top + bar.height;
  for (int k = 0; k < steps; ++k) {
    const int from = height * k / steps, to = height * std::min(k + 2, steps) / steps;
    const int color = steps > 1 ? (2 * last * k + steps - 1) / (2 * (steps - 1)) : (last + 1) / 2;
    legend.boxes.push_back({bar.left, bottom - to, bar.width, static_cast<double>(to - from),
                            palette[static_cast<std::size_t>(color)]});
  }
}

/// Where a legend begins, its pixels per unit, and the color of what has none of its own.
struct Spot {
  double left, top;
  Scale scale;
  std::uint32_t ink;
};

/// Adds the title, the bar with its labels, and the rows.
void addContents(Legend& legend, const Contents& contents, const Spot& spot, const Palette& palette,
                 bool equal) {
  const int unit = spot.scale.unit;
  const double text_height = letter_units * unit, line = std::max(1, unit / 2);
  const double inside = spot.left + padding * unit;
  double baseline = spot.top + padding * unit + text_height;
  for (std::size_t i = 0; i < contents.title.size(); ++i) {
    legend.texts.push_back({inside, baseline, text_height, Anchor::start, contents.title[i], spot.ink});
    if (i + 1 < contents.title.size()) baseline += line_height * unit;
  }
  const LegendBox bar{inside, baseline + title_gap * unit, static_cast<double>(bar_width) * unit,
                      static_cast<double>(spot.scale.bar), 0};
  const double right = bar.left + bar.width;
  double next = bar.top;
  if (!contents.labels.empty()) {
    legend.boxes.push_back(
        {bar.left - line, bar.top - line, bar.width + 2 * line, bar.height + 2 * line, line_color});
    addBar(legend, bar, palette, equal);
    for (const Label& label : contents.labels) {
      const double y = bar.top + std::round((1 - label.place) * bar.height);
      legend.boxes.push_back({right, y - std::ceil(line / 2), tick_length * unit + line, line, line_color});
      legend.texts.push_back({right + label_gap * unit, y + std::floor(text_height / 2), text_height,
                              Anchor::start, label.text, spot.ink});
    }
    next += bar.height + rows_gap * unit;
  }
  for (const Row& row : contents.rows) {
    constexpr int to_baseline = (swatch_height + letter_units) / 2;
    const double height = swatch_height * unit;
    if (row.rgba) {
      legend.boxes.push_back(
          {bar.left - line, next - line, bar.width + 2 * line, height + 2 * line, line_color});
      legend.boxes.push_back({bar.left, next, bar.width, height, *row.rgba});
    }
    legend.texts.push_back({right + label_gap * unit, next + to_baseline * unit, text_height, Anchor::start,
                            row.text, spot.ink});
    next += row_height * unit;
  }
}

/// Entries of the palette that a bar shows: one of values keeps the last for other things.
Palette barPalette(const ColorKey& key, const Palette& palette) {
  Palette colors = palette;
  if (key.color == ColorBy::value)
    std::ranges::fill(colors.begin() + other_names_color, colors.end(), palette[other_names_color - 1]);
  return colors;
}

Palette paletteFor(const RenderOptions& options, const ColorKey& key) {
  return paletteOf(options, key).value_or(Palette{});
}

bool isEqual(const ColorKey& key) { return !(key.range.low < key.range.high); }

}  // namespace

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
  Contents contents{titleOf(key, options), labelsOf(key, width)};
  const int room = width - 2 * margin - 2 * padding;
  for (std::string& line : contents.title) line = shortened(std::move(line), room);
  Contents in_one_line = contents;
  in_one_line.title = {fmt::format("{}", fmt::join(contents.title, ", "))};
  if (in_one_line.width() + 2 * margin <= width) contents = std::move(in_one_line);
  // What is left of the height for rows beside the shortest bar.
  const int shortest_bar = contents.labels.empty() ? 0 : 2 * label_distance;
  const int rest = height - 2 * margin - contents.height() - shortest_bar - (shortest_bar > 0 ? rows_gap : 0);
  contents.rows = rowsOf(key, palette, static_cast<std::size_t>(std::max(0, rest / row_height)),
                         room - bar_width - label_gap);
  const Scale scale = scaleFor(contents, width, height);
  const auto [unit, bar_pixels] = scale;
  dropCrowded(contents.labels, static_cast<double>(bar_pixels) / unit);

  Legend legend;
  const double panel_width = contents.width() * unit, panel_height = contents.height() * unit + bar_pixels;
  const double left = margin * unit, top = height - margin * unit - panel_height;
  legend.boxes.push_back({left, top, panel_width, panel_height, panel_color});
  addContents(legend, contents, {left, top, scale, black}, barPalette(key, palette), isEqual(key));
  return legend;
}

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
  Contents contents{titleOf(key, options), labelsOf(key, widest)};
  std::vector<std::string> title;
  for (const std::string& line : contents.title)
    std::ranges::move(linesOf(line, widest), std::back_inserter(title));
  contents.title = std::move(title);
  contents.rows = rowsOf(key, palette, rows_without_end, widest);
  const auto heightAt = [&](int size) { return (contents.height() + contents.barUnits()) * size; };
  while (unit > 1 && heightAt(unit) > options.height) --unit;
  dropCrowded(contents.labels, contents.barUnits());
  const double left = options.width + margin * unit;
  // The text begins at the picture's upper edge.
  addContents(sheet.legend, contents,
              {left, static_cast<double>(-padding * unit), {unit, contents.barUnits() * unit}, ink},
              barPalette(key, palette), isEqual(key));
  sheet.right += (margin + contents.width()) * unit;
  sheet.bottom += std::max(0, heightAt(unit) - 2 * padding * unit - options.height);
}

}  // namespace

Sheet sheetOf(const RenderOptions& options, const std::optional<ColorKey>& key) {
  const bool beside = options.legend && options.legend_beside && key;
  if (options.title.empty() && !beside) return {};
  constexpr double pictures_side = 350;
  const double side = std::sqrt(static_cast<double>(options.width) * options.height);
  const int unit = std::max(1, static_cast<int>(std::lround(side / pictures_side)));
  const std::uint32_t paper = options.background ? options.background->rgba : white, ink = inkOn(paper);
  const int border = padding * unit;
  Sheet sheet{border, border, border, border};
  if (beside) addBeside(sheet, *key, options, unit, ink);
  if (!options.title.empty()) {
    // Half as high again as the legend's.
    const int size = std::max(unit + 1, 3 * unit / 2), pitch = line_height * size;
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
