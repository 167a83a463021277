#include "cli/options/picture_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/try.h"
#include "cli/options/row_options.h"
#include "io/base/error.h"

namespace vorpipe::cli {
namespace {

Parsed<ColorScale> parseScale(std::string_view text) { return parseNameOf(text, ColorScale::linear); }

Parsed<ColorRange> parseColorRange(std::string_view text) {
  VORPIPE_LET(range, parseWeightRange(text));
  if (range.low == range.high) return tl::unexpected(fmt::format("LO {} is not below HI", range.low));
  return ColorRange{range.low, range.high};
}

}  // namespace

Parsed<SizeChoice> parseSizeChoice(std::string_view text) {
  if (text.find('x') != std::string_view::npos) {
    return parseSize(text).map([](PictureSize size) { return SizeChoice{size, 0}; });
  }
  const auto side = parseWhole(text, 1, largest_side);
  if (!side) {
    return tl::unexpected(
        fmt::format("{} is neither WxH, as in 800x600, nor the longer side, a whole number "
                    "from 1 to {}",
                    inQuotes(text), largest_side));
  }
  return SizeChoice{std::nullopt, static_cast<int>(*side)};
}

Option addFitOption(Options& options, std::optional<Fit>& fit) {
  return addParsed(
      options, "--fit", fit, anyOf(namesFrom<Fit>()),
      "what a domain does in a picture of another aspect: it is stretched to it, or keeps its own in the "
      "middle, with no site beside it [letterbox for files of sites and outlines, else stretch]",
      [](std::string_view text) { return parseNameOf<Fit>(text); }, {namesFrom<Fit>(), {}});
}

Option addViewOption(Options& options, std::optional<Box>& view) {
  return addParsed(
      options, "--view", view, "XMIN,YMIN,XMAX,YMAX",
      "what is drawn where that is not the whole domain: a part of it, or more, with no site beyond it; "
      "cells and colors stay as they are [the domain]",
      parseBox);
}

void addSizeOptions(Options& options, PictureOptions& picture) {
  addParsed(options, "--size", picture.size, "N or WxH",
            "pixels of the longer side, the other by the aspect of the domain or --view, or width and height "
            "[1000]",
            parseSizeChoice);
  addViewOption(options, picture.render.view);
  addFitOption(options, picture.fit);
}

void addColorOptions(Options& options, RenderOptions& picture) {
  addParsed(options, "--color", picture.color, "BY",
            fmt::format("what colors show: {} [site]", anyOf(colorNames())), parseColor, {colorNames(), {}});
  addParsed(options, "--colormap", picture.colormap, "NAME",
            fmt::format("the colors: {} [{}]", anyOf(colormaps()), picture.colormap), parseColormap,
            {colormaps(), {}});
  addParsed(options, "--color-scale", picture.color_scale, "KIND",
            "how values become colors: linear or log from the least to the greatest, or quantile, by rank "
            "[quantile by area and weight, linear by neighbors]",
            parseScale, {namesFrom(ColorScale::linear), {}});
  addParsed(
      options, "--color-range", picture.color_range, "LO,HI",
      "the values of the first and the last color; those beyond have the same, and quantiles are those of "
      "the values inside [all cells' values]",
      parseColorRange);
  options.addFlag("--legend", picture.legend, "draws what the colors stand for into the lower left corner");
}

void addMarkOptions(Options& options, PictureOptions& picture) {
  std::map<std::string_view, Option> flags;
  const auto add = [&](const auto& row) {
    Option option = addRow(options, row, picture.render, picture.given);
    if constexpr (requires { row.of; }) {
      // CLI11 has no option that needs one of two others.
      if (row.of[0] != nullptr && row.of[1] == nullptr) option.needs(flags.at(row.of[0]->name));
    } else {
      flags.emplace(row.name, option);
    }
  };
  forEachRow(mark_rows, add);
  options.addFlag("--no-fill", picture.no_fill, "leaves the cells white");
  add(antialias_row);
}

Result<void> checkMarks(const PictureOptions& picture) {
  Result<void> checked;
  const auto check = [&](const auto& row) {
    if constexpr (requires { row.least; }) {
      const auto& [one, other] = row.of;
      if (!checked || other == nullptr || !picture.given.contains(row.name)) return;
      if (picture.render.*one->member || picture.render.*other->member) return;
      checked = inputError(fmt::format("{}: needs {} or {}", flagOf(row), flagOf(*one), flagOf(*other)));
    }
  };
  forEachRow(mark_rows, check);
  return checked;
}

PictureSize sizeBefore(const SizeChoice& size) {
  return size.sides.value_or(PictureSize{std::max(1, size.longer_side), 1});
}

void addPictureGroup(Options& options, PictureOptions& picture) {
  options.group("Picture");
  addSizeOptions(options, picture);
  addColorOptions(options, picture.render);
  addMarkOptions(options, picture);
}

}  // namespace vorpipe::cli
