#include "cli/options/picture_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

constexpr double widest_mark = 100;

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
  const auto range = parseWeightRange(text);
  if (!range) return tl::unexpected(range.error());
  if (range->low == range->high) return tl::unexpected(fmt::format("LO {} is not below HI", range->low));
  return ColorRange{range->low, range->high};
}

/// A width or a height in pixels.
Parsed<double> parsePixels(std::string_view text, double least, double most = widest_mark) {
  const auto number = parseNumber(text);
  if (!number) return tl::unexpected(number.error());
  if (*number >= least && *number <= most) return *number;
  return tl::unexpected(fmt::format("{} is not a number of pixels from {} to {}", *number, least, most));
}

/// Parses the number of rows and columns of samples in a pixel.
Parsed<int> parsePlaces(std::string_view text) {
  constexpr std::uint64_t most = 8;
  const auto number = parseWhole(text, 1, most);
  if (!number) return tl::unexpected(number.error());
  return static_cast<int>(*number);
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
  RenderOptions& render = picture.render;
  options.addFlag("--edges", render.edges, "darkens the edges of the cells");
  options.addFlag("--dual", render.dual,
                  "draws lines between sites whose cells have a common edge in the domain: of the Delaunay "
                  "triangulation, what does not meet beyond; a larger --margin has more of it");
  addParsed(options, "--edge-width", picture.edge_width, "PX",
            fmt::format("how wide edges and lines of --dual are, 1 to {} pixels; edges in a .png without "
                        "--antialias have a whole number of them [1]",
                        widest_mark),
            [](std::string_view text) { return parsePixels(text, 1); });
  const Option sites = options.addFlag("--show-sites", render.show_sites, "draws a dot at each site");
  addParsed(
      options, "--dot-size", render.dot_size, "PX",
      fmt::format("how wide dots are, 1 to {} pixels [by the spacing of the sites that show]", widest_mark),
      [](std::string_view text) { return parsePixels(text, 1); })
      .needs(sites);
  const Option labels = options.addFlag(
      "--labels", render.labels,
      "writes the index of each site, counted from 0 as in --ids, into its cell where it has room");
  addParsed(options, "--label-size", render.label_size, "PX",
            fmt::format("how high the digits are, 5 to 200 pixels [{}]", render.label_size),
            [](std::string_view text) { return parsePixels(text, 5, 200); })
      .needs(labels);
  options.addFlag("--no-fill", picture.no_fill, "leaves the cells white");
  addParsed(options, "--antialias", render.antialias, "N",
            "smooths a .png: each pixel has the mean color of N x N places, 1 to 8; --ids are those of the "
            "centers [1]",
            parsePlaces);
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
