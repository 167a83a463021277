#include "picture/legend.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

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
constexpr int label_distance = 11;         ///< of two baselines
constexpr std::size_t longest_label = 10;  ///< fits into every picture

struct Label {
  double place;  ///< along the colors
  std::string text;
};

/// The texts, with sizes in units.
struct Contents {
  std::vector<std::string> title;  ///< lines
  std::vector<Label> labels;       ///< ascending

  [[nodiscard]] int width() const {
    int widest = 0;
    for (const std::string& line : title) widest = std::max(widest, unitsOf(line));
    for (const Label& label : labels) widest = std::max(widest, bar_width + label_gap + unitsOf(label.text));
    return widest + 2 * padding;
  }
  /// Without the bar.
  [[nodiscard]] int height() const {
    const int lines = static_cast<int>(title.size());
    return padding + (lines - 1) * line_height + letter_units + title_gap + bottom_gap + padding;
  }
};

std::vector<std::string> titleOf(const ColorKey& key) {
  std::vector<std::string> title;
  title.emplace_back(nameOf(key.color));
  if (key.scale == ColorScale::log) title.emplace_back("log");
  if (key.scale == ColorScale::quantile) title.emplace_back("quantiles");
  return title;
}

/// The labels of the ticks of `key`, with enough digits to distinguish them, if a picture of this width has
/// room. One of equal labels stays, preferably that of an end.
std::vector<Label> labelsOf(const ColorKey& key, int width) {
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
  while (unit > 1 && !(fits(contents.width(), width) && fits(contents.height() + bar_height, height))) --unit;
  if (unit > 1) return {unit, bar_height * unit};
  const int highest = std::max(static_cast<int>(most * height), least_with_legend.height) - 2 * margin;
  return {1, std::clamp(std::min(highest, height - 2 * margin) - contents.height(), 1, bar_height)};
}

/// Draws the colors from `bottom` upward. Each box overlaps the next, which is drawn over it, so that
/// antialiasing shows no seams.
void addBar(Legend& legend, const LegendBox& bar, const Palette& palette, bool equal) {
  const int last = static_cast<int>(palette.size()) - 1;
  const int height = static_cast<int>(bar.height);
  const int steps = equal ? 1 : std::min(static_cast<int>(palette.size()), height);
  const double bottom = bar.top + bar.height;
  for (int k = 0; k < steps; ++k) {
    const double from = height * k / steps, to = height * std::min(k + 2, steps) / steps;
    const int color = steps > 1 ? (2 * last * k + steps - 1) / (2 * (steps - 1)) : (last + 1) / 2;
    legend.boxes.push_back(
        {bar.left, bottom - to, bar.width, to - from, palette[static_cast<std::size_t>(color)]});
  }
}

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

Legend legendOf(const ColorKey& key, const std::string& colormap, int width, int height) {
  Contents contents{titleOf(key), labelsOf(key, width)};
  Contents in_one_line = contents;
  in_one_line.title = {fmt::format("{}", fmt::join(contents.title, ", "))};
  if (in_one_line.width() + 2 * margin <= width) contents = std::move(in_one_line);
  const auto [unit, bar_pixels] = scaleFor(contents, width, height);
  dropCrowded(contents.labels, static_cast<double>(bar_pixels) / unit);

  Legend legend;
  const double panel_width = contents.width() * unit, panel_height = contents.height() * unit + bar_pixels;
  const double left = margin * unit, top = height - margin * unit - panel_height;
  legend.boxes.push_back({left, top, panel_width, panel_height, panel_color});
  const double text_height = letter_units * unit, line = std::max(1, unit / 2);
  const double inside = left + padding * unit;
  double baseline = top + padding * unit + text_height;
  for (std::size_t i = 0; i < contents.title.size(); ++i) {
    legend.texts.push_back({inside, baseline, text_height, Anchor::start, contents.title[i]});
    if (i + 1 < contents.title.size()) baseline += line_height * unit;
  }
  const LegendBox bar{inside, baseline + title_gap * unit, static_cast<double>(bar_width) * unit,
                      static_cast<double>(bar_pixels), 0};
  legend.boxes.push_back(
      {bar.left - line, bar.top - line, bar.width + 2 * line, bar.height + 2 * line, line_color});
  const auto palette = paletteByName(colormap);
  if (palette) addBar(legend, bar, *palette, !(key.range.low < key.range.high));
  for (const Label& label : contents.labels) {
    const double y = bar.top + std::round((1 - label.place) * bar.height);
    const double right = bar.left + bar.width;
    legend.boxes.push_back({right, y - std::ceil(line / 2), tick_length * unit + line, line, line_color});
    legend.texts.push_back(
        {right + label_gap * unit, y + std::floor(text_height / 2), text_height, Anchor::start, label.text});
  }
  return legend;
}

}  // namespace vorpipe
