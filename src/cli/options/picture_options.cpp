#include "cli/options/picture_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/try.h"
#include "cli/options/row_options.h"
#include "io/base/error.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/sites/photograph_file.h"

namespace vorpipe::cli {
namespace {

Parsed<ColorScale> parseScale(std::string_view text) { return parseNameOf(text, ColorScale::linear); }

constexpr std::array<std::string_view, 2> legend_places{"inside", "beside"};

Parsed<std::string_view> parseLegendPlace(std::string_view text) {
  if (text.empty()) return legend_places[0];
  const auto* const found = std::ranges::find(legend_places, text);
  if (found != legend_places.end()) return *found;
  return tl::unexpected(fmt::format("{} is neither inside nor beside", inQuotes(text)));
}

Parsed<ColormapChoice> parseListedColormap(std::string_view text) {
  VORPIPE_VAR(choice, parseColormap(text));
  if (choice.file.empty()) return choice;
  return tl::unexpected(fmt::format("{} is a file; list its colors, with commas", inQuotes(text)));
}

/// Without a value, labels are indices.
Parsed<std::string> parseLabels(std::string_view text) {
  return text.empty() ? std::string() : parseAttribute(text);
}

/// What pictures cannot show of sites that are edited, or of a fluid's.
tl::unexpected<std::string> ofSavedSites(std::string_view text, std::string_view instead) {
  return tl::unexpected(
      fmt::format("{} is for render, relax and transport; here {}", inQuotes(text), instead));
}

Parsed<bool> parseIndexLabels(std::string_view text) {
  if (text.empty()) return true;
  return ofSavedSites(text, "labels are indices");
}

Parsed<bool> parseLegendInside(std::string_view text) {
  VORPIPE_LET(place, parseLegendPlace(text));
  if (place == legend_places[0]) return true;
  return ofSavedSites(text, "the legend is inside");
}

Parsed<ColorBy> parsePlainColor(std::string_view text) {
  if (!text.starts_with('@') && !isPhotograph(text)) return parseColor(text);
  return ofSavedSites(text, fmt::format("colors show {}", anyOf(colorNames())));
}

struct ColorChoice {
  ColorBy by = ColorBy::site;
  std::string attribute, photograph;
};

Parsed<ColorChoice> parseColorChoice(std::string_view text) {
  if (text.starts_with('@')) {
    return parseAttribute(text).map([](std::string name) {
      return ColorChoice{ColorBy::value, std::move(name), {}};
    });
  }
  if (isPhotograph(text)) return ColorChoice{ColorBy::site, {}, std::string(text)};
  const auto by = parseColor(text);
  if (by) return ColorChoice{*by, {}, {}};
  return tl::unexpected(
      fmt::format("{}; nor @NAME, an attribute, nor a photograph, .png or .jpg", by.error()));
}

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

/// --colormap; `kinds` are the other kinds that it takes, in words.
template <class Parse, class Keep>
void addColormap(Options& options, std::string_view kinds, std::vector<std::string> extensions,
                 const Parse& parse, const Keep& keep) {
  options.add(
      "--colormap", parsedValue("NAME", parse, keep, {colormaps(), std::move(extensions)}),
      fmt::format("the colors: {}; or own ones, as in '#003366,white,tomato'{} [{}; of names and distinct "
                  "cells those of Okabe and Ito]",
                  anyOf(colormaps()), kinds, colormapOf({})));
}

/// --color-scale, --color-range
void addScaleOptions(Options& options, RenderOptions& picture) {
  addParsed(options, "--color-scale", picture.color_scale, "KIND",
            "how values become colors: linear or log from the least to the greatest, or quantile, by rank "
            "[quantile by area and weight, linear by neighbors and attributes]",
            parseScale, {namesFrom(ColorScale::linear), {}});
  addParsed(
      options, "--color-range", picture.color_range, "LO,HI",
      "the values of the first and the last color; those beyond have the same, and quantiles are those of "
      "the values inside [all cells' values]",
      parseColorRange);
}

/// --legend, --legend-title, --title
void addSheetOptions(Options& options, RenderOptions& picture) {
  const auto keep = [&picture](std::string_view place) {
    picture.legend = true;
    picture.legend_beside = place == legend_places[1];
  };
  const Option legend = options.addOptional(
      "--legend", parsedValue("PLACE", parseLegendPlace, keep, {{"inside", "beside"}, {}}),
      "draws what the colors stand for: inside, in the lower left corner, or beside the picture, which is "
      "wider for it [inside]");
  options
      .addText("--legend-title", picture.legend_title, "TEXT",
               "above the legend, as in 'rain, mm' [what --color shows]")
      .needs(legend);
  options.addText("--title", picture.title, "TEXT", "above the picture, which is higher for it");
}

}  // namespace

void addColorOptions(Options& options, RenderOptions& picture) {
  addParsed(
      options, "--color", picture.color, "BY",
      fmt::format("what colors show: {}; distinct: cells with a common edge differ, with few colors [site]",
                  anyOf(colorNames())),
      parsePlainColor, {colorNames(), {}});
  addColormap(options, "", {}, parseListedColormap, [&picture](ColormapChoice choice) {
    picture.colormap = std::move(choice.name);
    picture.colors = std::move(choice.colors);
  });
  addScaleOptions(options, picture);
  options.addOptional("--legend",
                      parsedValue("inside", parseLegendInside,
                                  [&picture](bool is_there) { picture.legend = is_there; }, {{"inside"}, {}}),
                      "draws what the colors stand for into the lower left corner");
}

void addColorOptions(Options& options, PictureOptions& picture) {
  const auto keep = [&picture](ColorChoice choice) {
    picture.render.color = choice.by;
    picture.color_attribute = std::move(choice.attribute);
    picture.photograph.file = std::move(choice.photograph);
  };
  Choices choices{colorNames(), {".png", ".jpg", ".jpeg"}};
  choices.words.emplace_back("@");
  Option color = options.add(
      "--color", parsedValue("BY or FILE", parseColorChoice, keep, std::move(choices)),
      fmt::format(
          "what colors show: {}, where cells with a common edge differ, with few colors; or @NAME, an "
          "attribute of the sites; or a photograph, .png or .jpg, over the domain or where a world file "
          "beside it says: cells have the mean color of its pixels [site]",
          anyOf(colorNames())));
  addParsed(
      options, "--color-box", picture.photograph.box, "XMIN,YMIN,XMAX,YMAX",
      "where the pixels of a photograph lie, as --density-box; cells beyond it are white [the domain's box]",
      parseBox)
      .needs(color);
  addColormap(options, ", or a FILE with one to a line", {".txt"}, parseColormap,
              [&picture](ColormapChoice choice) {
                picture.render.colormap = std::move(choice.name);
                picture.render.colors = std::move(choice.colors);
                picture.colors_file = std::move(choice.file);
              });
  addScaleOptions(options, picture.render);
  addSheetOptions(options, picture.render);
}

void addMarkOptions(Options& options, PictureOptions& picture, LabelsOf labels) {
  std::map<std::string_view, Option> flags;
  const auto keep_labels = [&picture](std::string attribute) {
    picture.render.labels = true;
    picture.label_attribute = std::move(attribute);
  };
  const auto addLabels = [&] {
    if (labels == LabelsOf::attributes) {
      return options.addOptional(
          flagOf(labels_row), parsedValue("@NAME", parseLabels, keep_labels, {{"@"}, {}}), labels_row.help);
    }
    return options.addOptional(
        flagOf(labels_row),
        parsedValue("", parseIndexLabels, [&picture](bool drawn) { picture.render.labels = drawn; }, {}),
        "writes the index of each site, counted from 0, into its cell where it has room");
  };
  const auto add = [&](const auto& row) {
    if constexpr (requires { row.of; }) {
      Option option = addRow(options, row, picture.render, picture.given);
      // CLI11 has no option that needs one of two others.
      if (row.of[0] != nullptr && row.of[1] == nullptr) option.needs(flags.at(row.of[0]->name));
    } else if (std::string_view(row.name) == labels_row.name) {
      flags.emplace(row.name, addLabels());
    } else {
      flags.emplace(row.name, addRow(options, row, picture.render, picture.given));
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

void addMapOptions(Options& options, PictureOptions& picture) {
  options.add("--map",
              parsedValue(
                  "NAME", [](std::string_view text) { return parseNameOf<GlobeMap>(text); },
                  [&picture](GlobeMap map) {
                    picture.render.map = map;
                    picture.given.insert("map");
                  },
                  {namesFrom<GlobeMap>(), {}}),
              fmt::format("with --globe, the map of the Earth: {}, on which areas are true [{}]",
                          anyOf(namesFrom<GlobeMap>()), nameOf(picture.render.map)));
  addParsed(options, "--view-from", picture.render.view_from, "LON,LAT",
            "with --globe, the Earth as it is seen from far above this place, in degrees, in place of a map "
            "(orthographic)",
            parsePlace);
  addRow(options, graticule_row, picture.render, picture.given);
}

Result<void> checkMap(const PictureOptions& picture, bool globe) {
  const bool has_map = picture.given.contains("map"), has_place = picture.render.view_from.has_value();
  if (!globe) {
    const char* given = has_map                        ? "--map"
                        : has_place                    ? "--view-from"
                        : picture.render.graticule > 0 ? "--graticule"
                                                       : nullptr;
    if (given == nullptr) return {};
    return inputError(fmt::format("{}: is for --globe", given));
  }
  if (has_map && has_place) return inputError("--map: --view-from is a map of its own; leave one out");
  if (picture.fit) return inputError("--fit: is for a plane; maps of --globe keep their aspect");
  if (!picture.photograph.file.empty()) {
    return inputError("--color: a photograph is for a plane, not for --globe");
  }
  return {};
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
