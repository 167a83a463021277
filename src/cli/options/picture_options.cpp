#include "cli/options/picture_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/try.h"
#include "cli/options/row_options.h"
#include "io/base/error.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/sites/photograph_file.h"

namespace vorpipe::cli {
namespace {

Parsed<ColorScale> parseScale(std::string_view text) { return parseNameOf(text, ColorScale::linear); }

Parsed<ColorRange> parseColorRange(std::string_view text) {
  VORPIPE_LET(range, parseWeightRange(text));
  if (range.low == range.high) return tl::unexpected(fmt::format("LO {} is not below HI", range.low));
  return ColorRange{range.low, range.high};
}

constexpr double millimeters_of_inch = 25.4;

/// Parses a length on paper, or two of one unit.
Parsed<SizeChoice> parsePaper(std::string_view text, double millimeters) {
  constexpr double most = 10'000;
  const std::size_t cross = text.find('x');
  const auto length = [&](std::string_view part) -> Parsed<double> {
    VORPIPE_LET(number, parseNumber(part));
    if (number > 0 && number * millimeters <= most) return number * millimeters;
    return tl::unexpected(fmt::format("{} is not more than 0 and at most {} mm", inQuotes(part), most));
  };
  VORPIPE_LET(first, length(text.substr(0, cross)));
  if (cross == std::string_view::npos) return SizeChoice{{}, 0, PaperSize{first, 0}};
  VORPIPE_LET(second, length(text.substr(cross + 1)));
  return SizeChoice{{}, 0, PaperSize{first, second}};
}

int pixelsOf(double millimeters, double dpi) {
  return std::max(1, static_cast<int>(std::lround(millimeters / millimeters_of_inch * dpi)));
}

}  // namespace

Parsed<SizeChoice> parseSizeChoice(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 3> units{
      {{"mm", 1}, {"cm", 10}, {"in", millimeters_of_inch}}};
  for (const auto& [unit, millimeters] : units) {
    if (text.ends_with(unit)) return parsePaper(text.substr(0, text.size() - unit.size()), millimeters);
  }
  if (text.find('x') != std::string_view::npos) {
    return parseSize(text).map([](PictureSize size) { return SizeChoice{size, 0}; });
  }
  const auto side = parseWhole(text, 1, largest_side);
  if (!side) {
    return tl::unexpected(
        fmt::format("{} is neither WxH, as in 800x600, nor the longer side, a whole number "
                    "from 1 to {}, nor a length on paper, as 420x594mm",
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
  addParsed(
      options, "--size", picture.size, "N or WxH",
      "pixels of the longer side, the other by the aspect of the domain or --view, or width and height; or "
      "as much on paper with mm, cm or in, as 420x594mm: then widths of edges, dots and labels are in 1/96 "
      "inch [1000]",
      parseSizeChoice);
  addParsed(options, "--dpi", picture.dpi, "N",
            "pixels per inch of a .png whose --size is on paper, 10 to 2400 [300]",
            [&picture](std::string_view text) -> Parsed<double> {
              picture.given.insert("dpi");
              constexpr double least = 10, most = 2400;
              VORPIPE_LET(number, parseNumber(text));
              if (number >= least && number <= most) return number;
              return tl::unexpected(fmt::format("{} is not a number from {} to {}", number, least, most));
            });
  addViewOption(options, picture.render.view);
  addFitOption(options, picture.fit);
}

namespace {

/// --colormap, --color-scale, --color-range, --legend
void addScaleOptions(Options& options, RenderOptions& picture) {
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

}  // namespace

void addColorOptions(Options& options, RenderOptions& picture) {
  addParsed(options, "--color", picture.color, "BY",
            fmt::format("what colors show: {} [site]", anyOf(colorNames())), parseColor, {colorNames(), {}});
  addScaleOptions(options, picture);
}

void addColorOptions(Options& options, PictureOptions& picture) {
  const auto parse = [&](std::string_view text) {
    if (!isPhotograph(text)) return parseColor(text);
    picture.photograph.file = text;
    return Parsed<ColorBy>(ColorBy::site);
  };
  Option color = addParsed(
      options, "--color", picture.render.color, "BY or FILE",
      fmt::format(
          "what colors show: {}; or a photograph, .png or .jpg, over the domain or where a world file "
          "beside it says: cells have the mean color of its pixels [site]",
          anyOf(colorNames())),
      parse, {colorNames(), {".png", ".jpg", ".jpeg"}});
  addParsed(
      options, "--color-box", picture.photograph.box, "XMIN,YMIN,XMAX,YMAX",
      "where the pixels of a photograph lie, as --density-box; cells beyond it are white [the domain's box]",
      parseBox)
      .needs(color);
  addScaleOptions(options, picture.render);
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
  add(background_row);
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

Result<void> checkPaper(const PictureOptions& picture) {
  const auto& paper = picture.size.paper;
  if (!paper) {
    if (!picture.given.contains("dpi")) return {};
    return inputError("--dpi: is for a --size on paper, as 420x594mm");
  }
  const double inches = std::max(paper->width, paper->height) / millimeters_of_inch;
  if (inches * picture.dpi <= largest_side) return {};
  return inputError(fmt::format("--size: {:.6g} mm with --dpi {} are {:.0f} pixels; a side has at most {}",
                                inches * millimeters_of_inch, picture.dpi, inches * picture.dpi,
                                largest_side));
}

PictureSize sizeBefore(const PictureOptions& picture) {
  const SizeChoice& size = picture.size;
  if (!size.paper) return size.sides.value_or(PictureSize{std::max(1, size.longer_side), 1});
  const auto [width, height] = *size.paper;
  return {pixelsOf(width, picture.dpi), height > 0 ? pixelsOf(height, picture.dpi) : 1};
}

PictureSize sizeOf(const PictureOptions& picture, const Box& shown) {
  const SizeChoice& size = picture.size;
  if (size.paper && size.paper->height == 0) return sizeFor(shown, pixelsOf(size.paper->width, picture.dpi));
  if (size.paper) return sizeBefore(picture);
  return size.sides.value_or(size.longer_side > 0 ? sizeFor(shown, size.longer_side) : defaultSize(shown));
}

void addPictureGroup(Options& options, PictureOptions& picture) {
  options.group("Picture");
  addSizeOptions(options, picture);
  addColorOptions(options, picture);
  addMarkOptions(options, picture);
}

}  // namespace vorpipe::cli
