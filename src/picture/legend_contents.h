/// What a legend says, and how it is drawn from a place: the same in a picture and beside it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "picture/palette.h"
#include "vorpipe.h"

namespace vorpipe::core {

// Lengths in the units of the font.
inline constexpr int legend_margin = 3, legend_padding = 5, legend_line = 11;
inline constexpr int bar_width = 10, bar_height = 84, label_gap = 5;
inline constexpr int row_height = 12, rows_gap = 8;
inline constexpr int label_distance = 11;  ///< of two baselines

/// A number beside the bar.
struct LegendLabel {
  double place;  ///< along the colors
  std::string text;
};

/// A color that stands for one thing.
struct LegendRow {
  std::string text;
  std::optional<std::uint32_t> rgba{};  ///< none: a text alone
};

/// The texts, with sizes in units.
struct LegendContents {
  std::vector<std::string> title;     ///< lines
  std::vector<LegendLabel> labels{};  ///< ascending, of a bar; without them there is none
  std::vector<LegendRow> rows{};      ///< below it

  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;  ///< without the bar
  [[nodiscard]] int barUnits() const { return labels.empty() ? 0 : bar_height; }
};

/// Returns the title and the labels of a legend in a picture of this width, without rows.
LegendContents contentsOf(const ColorKey& key, const RenderOptions& options, int width);

/// Drops labels that would be too near to others beside a bar of that height. Keeps the ends, and then labels
/// nearest to the middle.
void dropCrowded(std::vector<LegendLabel>& labels, double height);

/// Cuts a text that is wider than `most` units.
std::string shortened(std::string text, int most);

/// Returns the rows of names and of missing values, at most `most`, whose texts have `room`.
std::vector<LegendRow> rowsOf(const ColorKey& key, const Palette& palette, std::size_t most, int room);

Palette paletteFor(const RenderOptions& options, const ColorKey& key);

/// Where a legend begins, its pixels per unit, the bar's height in pixels, and the color of what has none of
/// its own.
struct LegendSpot {
  double left, top;
  int unit, bar;
  std::uint32_t ink;
};

/// Adds the title, the bar with its labels, and the rows.
void addContents(Legend& legend, const LegendContents& contents, const LegendSpot& spot, const ColorKey& key,
                 const Palette& palette);

}  // namespace vorpipe::core
