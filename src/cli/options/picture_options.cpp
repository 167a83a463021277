#include "cli/options/picture_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <type_traits>

#include "base/option_rows.h"
#include "base/try.h"
#include "io/base/error.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

std::vector<std::string> scaleNames() { return {"linear", "log", "quantile"}; }
std::vector<std::string> fitNames() { return {"stretch", "letterbox"}; }

/// Returns the index of `text` in `names`.
Parsed<std::size_t> placeIn(const std::vector<std::string>& names, std::string_view text) {
  const auto found = std::ranges::find(names, text);
  if (found == names.end()) return tl::unexpected(fmt::format("{} is not {}", inQuotes(text), anyOf(names)));
  return static_cast<std::size_t>(found - names.begin());
}

Parsed<ColorScale> parseScale(std::string_view text) {
  constexpr std::array scales{ColorScale::linear, ColorScale::log, ColorScale::quantile};
  return placeIn(scaleNames(), text).map([&](std::size_t place) { return scales[place]; });
}

Parsed<Fit> parseFit(std::string_view text) {
  constexpr std::array fits{Fit::stretch, Fit::letterbox};
  return placeIn(fitNames(), text).map([&](std::size_t place) { return fits[place]; });
}

Parsed<ColorRange> parseColorRange(std::string_view text) {
  VORPIPE_LET(range, parseWeightRange(text));
  if (range.low == range.high) return tl::unexpected(fmt::format("LO {} is not below HI", range.low));
  return ColorRange{range.low, range.high};
}

/// Parses a number in the range of its row.
template <class Number>
Parsed<Number> parseNumberOf(const NumberRow<RenderOptions, Number>& row, std::string_view text) {
  if constexpr (std::is_integral_v<Number>) {
    const auto least = static_cast<std::uint64_t>(row.least_given),
               most = static_cast<std::uint64_t>(row.most);
    return parseWhole(text, least, most).map([](auto number) { return static_cast<Number>(number); });
  } else {
    VORPIPE_LET(number, parseNumber(text));
    if (number >= row.least_given && number <= row.most) return number;
    return tl::unexpected(
        fmt::format("{} is not a number of{} from {} to {}", number, row.unit, row.least_given, row.most));
  }
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
      options, "--fit", fit, anyOf(fitNames()),
      "what a domain does in a picture of another aspect: it is stretched to it, or keeps its own in the "
      "middle, with no site beside it [letterbox for files of sites and outlines, else stretch]",
      parseFit, {fitNames(), {}});
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
            parseScale, {scaleNames(), {}});
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
    auto& target = picture.render.*row.member;
    if constexpr (requires { row.least; }) {
      const auto parse = [&picture, row](std::string_view text) {
        picture.given.insert(row.name);
        return parseNumberOf(row, text);
      };
      const std::string help = fmt::format(fmt::runtime(row.help), row.least_given, row.most, target);
      Option option = addParsed(options, flagOf(row), target, row.value, help, parse);
      // CLI11 has no option that needs one of two others.
      if (row.of[0] != nullptr && row.of[1] == nullptr) option.needs(flags.at(row.of[0]->name));
    } else {
      flags.emplace(row.name, options.addFlag(flagOf(row), target, row.help));
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
