#include "picture/legend_contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/option_names.h"
#include "picture/font.h"
#include "picture/number_text.h"

namespace vorpipe::core {
namespace {

constexpr std::uint32_t line_color = 0xFF303030u;

// Lengths in the units of the font.
constexpr int title_gap = 9, bottom_gap = 3, tick_length = 2, swatch_height = 9;
constexpr std::size_t longest_label = 10;  ///< fits into every picture

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
std::vector<LegendLabel> labelsOf(const ColorKey& key, double factor, int width) {
  if (!key.names.empty()) return {};
  if (!(key.range.low < key.range.high)) return {{0.5, numberText(key.range.low * factor, 6)}};
  std::vector<double> values;
  for (const auto& [place, value] : key.ticks) values.push_back(value * factor);
  const int digit = unitsOf("00") - unitsOf("0");
  const int room = (width - 2 * (legend_margin + legend_padding) - bar_width - label_gap) / digit;
  auto texts = numberTexts(values, std::max(longest_label, static_cast<std::size_t>(std::max(0, room))));
  std::vector<LegendLabel> labels;
  for (std::size_t i = 0; i < values.size(); ++i) {
    LegendLabel label{key.ticks[i].first, std::move(texts[i])};
    if (labels.empty() || labels.back().text != label.text) {
      labels.push_back(std::move(label));
    } else if (i + 1 == values.size() && labels.size() > 1) {
      labels.back() = std::move(label);
    }
  }
  return labels;
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

/// Entries of the palette that a bar shows: one of values keeps the last for other things.
Palette barPalette(const ColorKey& key, const Palette& palette) {
  Palette colors = palette;
  if (key.color == ColorBy::value)
    std::ranges::fill(colors.begin() + other_names_color, colors.end(), palette[other_names_color - 1]);
  return colors;
}

bool isEqual(const ColorKey& key) { return !(key.range.low < key.range.high); }

}  // namespace

int LegendContents::width() const {
  int widest = 0;
  for (const std::string& line : title) widest = std::max(widest, unitsOf(line));
  for (const LegendLabel& label : labels)
    widest = std::max(widest, bar_width + label_gap + unitsOf(label.text));
  for (const LegendRow& row : rows) widest = std::max(widest, bar_width + label_gap + unitsOf(row.text));
  return widest + 2 * legend_padding;
}

int LegendContents::height() const {
  const int lines = static_cast<int>(title.size());
  const int below =
      static_cast<int>(rows.size()) * row_height + (rows.empty() || labels.empty() ? 0 : rows_gap);
  return legend_padding + (lines - 1) * legend_line + letter_units + title_gap + bottom_gap + legend_padding +
         below;
}

LegendContents contentsOf(const ColorKey& key, const RenderOptions& options, int width) {
  return {titleOf(key, options), labelsOf(key, options.legend_factor, width)};
}

void dropCrowded(std::vector<LegendLabel>& labels, double height) {
  std::ranges::stable_sort(labels, {}, [](const LegendLabel& label) {
    const bool is_end = label.place <= 0 || label.place >= 1;
    return is_end ? -1 : std::abs(label.place - 0.5);
  });
  std::vector<LegendLabel> kept;
  for (LegendLabel& label : labels) {
    const bool crowded = std::ranges::any_of(kept, [&](const LegendLabel& other) {
      return std::abs(label.place - other.place) * height < label_distance;
    });
    if (!crowded) kept.push_back(std::move(label));
  }
  std::ranges::sort(kept, {}, &LegendLabel::place);
  labels = std::move(kept);
}

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

std::vector<LegendRow> rowsOf(const ColorKey& key, const Palette& palette, std::size_t most, int room) {
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
  std::vector<LegendRow> rows;
  for (std::size_t k = 0; k < names; ++k) rows.push_back({shortened(key.names[k], room), palette[k]});
  if (left_out > 0 && most > 0) rows.push_back({fmt::format("and {} more", left_out)});
  if (others) rows.push_back({fmt::format("and {} others", key.other_names), palette[other_names_color]});
  if (missing) rows.push_back({"no value", palette[missing_color]});
  return rows;
}

Palette paletteFor(const RenderOptions& options, const ColorKey& key) {
  return paletteOf(options, key).value_or(Palette{});
}

void addContents(Legend& legend, const LegendContents& contents, const LegendSpot& spot, const ColorKey& key,
                 const Palette& palette) {
  const int unit = spot.unit;
  const double text_height = letter_units * unit, line = std::max(1, unit / 2);
  const double inside = spot.left + legend_padding * unit;
  double baseline = spot.top + legend_padding * unit + text_height;
  for (std::size_t i = 0; i < contents.title.size(); ++i) {
    legend.texts.push_back({inside, baseline, text_height, Anchor::start, contents.title[i], spot.ink});
    if (i + 1 < contents.title.size()) baseline += legend_line * unit;
  }
  const LegendBox bar{inside, baseline + title_gap * unit, static_cast<double>(bar_width) * unit,
                      static_cast<double>(spot.bar), 0};
  const double right = bar.left + bar.width;
  double next = bar.top;
  if (!contents.labels.empty()) {
    legend.boxes.push_back(
        {bar.left - line, bar.top - line, bar.width + 2 * line, bar.height + 2 * line, line_color});
    addBar(legend, bar, barPalette(key, palette), isEqual(key));
    for (const LegendLabel& label : contents.labels) {
      const double y = bar.top + std::round((1 - label.place) * bar.height);
      legend.boxes.push_back({right, y - std::ceil(line / 2), tick_length * unit + line, line, line_color});
      legend.texts.push_back({right + label_gap * unit, y + std::floor(text_height / 2), text_height,
                              Anchor::start, label.text, spot.ink});
    }
    next += bar.height + rows_gap * unit;
  }
  for (const LegendRow& row : contents.rows) {
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

}  // namespace vorpipe::core
