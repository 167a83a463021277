#include "cli/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "base/option_rows.h"
#include "base/try.h"
#include "io/base/error.h"
#include "io/base/line_reader.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/cells/forecast_files.h"
#include "io/sites/attribute_values.h"
#include "vorpipe/free_surface.h"
#include "vorpipe/label_room.h"
#include "vorpipe/shapes.h"

namespace vorpipe::cli {
namespace {

/// Reads opaque colors, one to a line, as readColor() takes them; empty lines are skipped. Errors (input),
/// with file and line: a line is no such color; there are fewer than 2 or more than 254.
Result<std::vector<Color>> readColors(const std::string& path) {
  VORPIPE_VAR(file, InputFile::open(path));
  LineReader lines(std::move(file));
  std::vector<Color> colors;
  while (true) {
    VORPIPE_LET(line, lines.next());
    if (!line) break;
    const std::string_view text = trimmed(*line);
    if (text.empty()) continue;
    const std::size_t column = static_cast<std::size_t>(text.data() - line->data()) + 1;
    const auto color = parseOpaqueColor(text);
    if (!color) return lines.errorAt(column, color.error());
    if (colors.size() == most_colors)
      return lines.errorAt(column, fmt::format("more than {} colors", most_colors));
    colors.push_back(*color);
  }
  if (colors.size() < 2)
    return inputError(fmt::format("{}: has {} colors, and takes two or more", path, colors.size()));
  return colors;
}

/// Returns the first given option that maps values to colors.
std::string_view scaleOption(const RenderOptions& picture) {
  if (picture.color_scale != ColorScale::automatic) return "--color-scale";
  if (picture.color_range) return "--color-range";
  return picture.legend ? "--legend" : "";
}

/// Checks what can be wrong with a picture before its cells are known.
Result<void> checkPicture(const RenderOptions& picture, const InputOptions& sites, const Input& input) {
  if (picture.color == ColorBy::weight && input.sites.weight.empty()) {
    return inputError(
        fmt::format("--color: weight needs weights; {} has none, and there is no --weights", sites.sites));
  }
  const std::string_view scaled = scaleOption(picture);
  if (picture.legend && !picture.fill) {
    return inputError("--legend: cells have no colors with --no-fill");
  }
  if (!colorsHaveKey(picture.color) && !scaled.empty()) {
    return inputError(fmt::format("{}: {} stand for no values; name --color area, neighbors or weight",
                                  scaled,
                                  picture.color == ColorBy::site ? "colors by site" : "distinct colors"));
  }
  if (picture.color_scale == ColorScale::log && picture.color_range && picture.color_range->low <= 0) {
    return inputError(fmt::format("--color-range: LO {} is not above 0, as --color-scale log needs it",
                                  picture.color_range->low));
  }
  const auto [width, height] = least_with_legend;
  if (picture.legend && !picture.legend_beside && (picture.width < width || picture.height < height)) {
    return inputError(fmt::format("--legend: has no room in {}x{} pixels, it takes {}x{}", picture.width,
                                  picture.height, width, height));
  }
  return {};
}

/// Takes the size, and on paper widths of marks in 1/96 inch. Errors (input): too large for a picture.
Result<void> takeSize(const PictureOptions& picture, RenderOptions& options) {
  VORPIPE_TRY(checkPaper(picture));
  const PictureSize size = sizeOf(picture, shownBox(options));
  options.width = size.width;
  options.height = size.height;
  if (!picture.size.paper) return {};
  constexpr double millimeters_of_inch = 25.4, unit = 96;
  const double millimeters = millimeters_of_inch / picture.dpi, pixels = picture.dpi / unit;
  const PaperSize& given = *picture.size.paper;
  const bool whole = given.height > 0;
  options.paper = PaperSize{whole ? given.width : size.width * millimeters,
                            whole ? given.height : size.height * millimeters};
  Result<void> taken;
  const auto scale = [&](const auto& row) {
    if constexpr (std::is_same_v<std::decay_t<decltype(options.*row.member)>, double>) {
      double& value = options.*row.member;
      if (value == 0 || !taken) return;
      const double scaled = std::max(row.least_given, value * pixels);
      if (scaled > row.most) {
        taken = inputError(fmt::format("{}: {} with --dpi {} is {:.6g} pixels; {} are the most", flagOf(row),
                                       value, picture.dpi, scaled, row.most));
      }
      value = scaled;
    }
  };
  forEachRow(mark_rows, scale);
  return taken;
}

/// Returns the options of the cells for a picture's shapes.
CellsOptions shapesOptions(const RenderOptions& picture) {
  CellsOptions cells = cellsOptions(picture);
  cells.detail = Detail::polygons;
  return cells;
}

/// Checks what can be wrong with a photograph before it is read.
Result<void> checkPhotograph(const PictureOptions& picture) {
  const PhotographChoice& photograph = picture.photograph;
  if (photograph.file.empty()) {
    if (!photograph.box) return {};
    return inputError("--color-box: is for a photograph that --color names");
  }
  const std::string_view scaled = scaleOption(picture.render);
  if (!scaled.empty())
    return inputError(fmt::format("{}: colors of a photograph stand for no values", scaled));
  if (picture.no_fill) return inputError("--color: cells have no colors with --no-fill");
  return {};
}

}  // namespace

Result<PhotographFile> photographOf(const PictureOptions& picture, const InputOptions& sites, Input& input) {
  const auto& [path, box] = picture.photograph;
  if (path.empty()) return {};
  auto read = readPhotograph(path, box);
  if (!read) return named("--color", std::move(read.error()));
  VORPIPE_TRY(placePhotograph(*read, path, input, domainWords(sites), "--color", "--color-box"));
  return read;
}

Result<void> takeColors(const PhotographFile& photograph, const Sites& sites, int threads,
                        RenderOptions& options) {
  if (photograph.photograph.rgba.empty()) return {};
  VORPIPE_VAR(colors, photographColors(sites, photograph.photograph, cellsOptions(options), threads));
  options.site_colors = std::move(colors);
  return {};
}

namespace {

/// All rings of the parts of an outline.
Outline bordersOf(const std::vector<Outline>& parts) {
  Outline borders;
  if (parts.empty()) return borders;
  borders.ring_offsets = borders.polygon_offsets = {0};
  for (const Outline& part : parts) {
    const auto points = borders.points.size(), rings = borders.ring_offsets.size() - 1;
    borders.points.insert(borders.points.end(), part.points.begin(), part.points.end());
    for (std::size_t r = 1; r < part.ring_offsets.size(); ++r)
      borders.ring_offsets.push_back(points + part.ring_offsets[r]);
    for (std::size_t p = 1; p < part.polygon_offsets.size(); ++p)
      borders.polygon_offsets.push_back(rings + part.polygon_offsets[p]);
  }
  return borders;
}

/// Finds what the colors and the labels show of the sites.
Result<void> takeAttributes(const PictureOptions& picture, const Input& input, RenderOptions& options) {
  if (!picture.color_attribute.empty()) {
    const auto values =
        attributeNamed(input.attributes, picture.color_attribute).and_then([](const Attribute* attribute) {
          return valuesOf(*attribute);
        });
    if (!values) return named("--color", values.error());
    options.values = *values;
    if (!values->names.empty() && !scaleOption(options).empty() && scaleOption(options) != "--legend") {
      return inputError(
          fmt::format("{}: the values of @{} are no numbers", scaleOption(options), picture.color_attribute));
    }
  }
  if (!picture.label_attribute.empty()) {
    const auto attribute = attributeNamed(input.attributes, picture.label_attribute);
    if (!attribute) return named("--labels", attribute.error());
    options.texts = textsOf(**attribute);
  }
  if (!picture.colors_file.empty()) {
    auto colors = readColors(picture.colors_file);
    if (!colors) return named("--colormap", std::move(colors.error()));
    options.colors = std::move(*colors);
  }
  const auto unit = input.globe ? std::optional(1.0) : squareKilometersIn(input.system);
  if (options.legend_beside && options.legend_title.empty() && options.color == ColorBy::area && unit) {
    options.legend_title = areas_in_kilometers;
    options.legend_factor = *unit;
  }
  return {};
}

}  // namespace

Result<RenderOptions> pictureOf(const PictureOptions& picture, const InputOptions& sites,
                                const Input& input) {
  RenderOptions options = picture.render;
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  options.globe = input.globe;
  options.borders = bordersOf(input.parts);
  VORPIPE_TRY(checkMap(picture, input.globe));
  if (input.globe && !options.view) {
    auto shown = domainOnMap(options);
    if (!shown) return asOption(std::move(shown.error()), sites);
    options.view = *shown;
  }
  VORPIPE_TRY(takeSize(picture, options));
  options.fit = input.globe ? Fit::letterbox : picture.fit.value_or(usualFit(input));
  options.fill = !picture.no_fill;
  VORPIPE_TRY(checkMarks(picture));
  VORPIPE_TRY(checkPhotograph(picture));
  VORPIPE_TRY(takeAttributes(picture, input, options));
  if (auto checked = checkView(options); !checked) return inputError("--view: " + checked.error().message);
  VORPIPE_TRY(checkPicture(options, sites, input));
  return options;
}

std::string stretchNote(const PictureOptions& picture, const RenderOptions& options) {
  if (picture.fit || options.fit != Fit::stretch || !picture.size.sides) return {};
  const auto [width, height] = *picture.size.sides;
  const Box& shown = shownBox(options);
  const PictureFrame kept = frameOf(shown, width, height, Fit::letterbox);
  if (kept.width == width && kept.height == height) return {};
  return fmt::format("--size {}x{} stretches the {} of {:.6g} x {:.6g}; --size {} keeps its aspect", width,
                     height, options.view ? "view" : "domain", shown.xmax - shown.xmin,
                     shown.ymax - shown.ymin, std::max(width, height));
}

Result<void> checkDiscs(const Sites& sites) {
  if (!sites.weight.empty()) return {};
  return inputError("--surface: the sites have no weights, which are the squared radii of their discs");
}

Result<void> checkFreePicture(std::string_view option, const RenderOptions& options,
                              const DrawingNeeds& needs) {
  if (!needs.pixels) return {};
  const bool over_air = options.legend || options.labels || options.dual || options.show_sites;
  // Pixels get the colors of cells that fill the domain.
  const bool of_cells = options.color == ColorBy::area || options.color == ColorBy::neighbors;
  if (!over_air && !of_cells) return {};
  return inputError(
      fmt::format("{}: with a free surface, pictures of pixels have no legend, labels, dual, sites or colors "
                  "by area and neighbors; .svg and .pdf have them",
                  option));
}

Result<Diagram> cellsWith(Surface surface, Session& session, const Sites& sites,
                          const CellsOptions& options) {
  return surface == Surface::free ? freeCells(session, sites, options) : session.cells(sites, options);
}

Result<Drawing> draw(Surface surface, Session& session, const Sites& sites, const RenderOptions& options,
                     const DrawingNeeds& needs) {
  const bool is_free = surface == Surface::free;
  Drawing drawing;
  if (needs.pixels) {
    VORPIPE_VAR(pixels, session.render(sites, options));
    if (is_free) {
      VORPIPE_TRY(takeOutAir(sites, options, pixels.image, session.threads()));
    } else {
      drawing.key = pixels.key;
    }
    drawing.pixels = std::move(pixels);
  }
  if (needs.cells) {
    VORPIPE_VAR(cells, cellsWith(surface, session, sites, shapesOptions(options)));
    drawing.cells = std::move(cells);
  }
  if (!needs.pixels && hasNames(options)) {
    VORPIPE_LET(labels, siteLabels(sites, *drawing.cells, options, session.threads()));
    std::string note = noteOnRoom(*drawing.cells, options, labels);
    if (!note.empty()) drawing.cells->report.notes.push_back(std::move(note));
  }
  if (!needs.pixels && !is_free) {
    VORPIPE_VAR(colors, siteColors(sites, *drawing.cells, options));
    drawing.key = std::move(colors.key);
  }
  return drawing;
}

Result<std::vector<std::string>> checkDrawing(const Sites& sites, const RenderOptions& options,
                                              const Drawing& drawing, int threads) {
  std::vector<std::string> broken;
  const auto take = [&](Result<std::vector<std::string>> found) -> Result<void> {
    if (!found) return tl::unexpected(std::move(found.error()));
    broken.insert(broken.end(), found->begin(), found->end());
    return {};
  };
  if (drawing.pixels) {
    VORPIPE_TRY(take(check(sites, options, *drawing.pixels, threads)));
  }
  if (drawing.cells) {
    VORPIPE_TRY(take(check(sites, shapesOptions(options), *drawing.cells, threads)));
  }
  return broken;
}

void planDrawing(MemoryPlan& plan, const Workload& work, const RenderOptions& options,
                 const DrawingNeeds& needs, bool checks) {
  if (needs.pixels) planPicture(plan, work, options);
  if (needs.cells) planCells(plan, work, Detail::polygons);
  if (checks && needs.pixels) planPictureCheck(plan, work, options);
  if (checks && needs.cells) planCellsCheck(plan, work, Detail::polygons);
  if (needs.cells) planShapes(plan, work, options);
}

void planColors(MemoryPlan& plan, const Workload& work, const PictureOptions& picture) {
  // Sums of three channels and a count, and the color.
  constexpr std::uint64_t bytes_of_site = 4 * sizeof(std::uint64_t) + sizeof(std::uint32_t),
                          places = 28'000'000;
  if (!picture.photograph.file.empty())
    plan.take("colors of a photograph", places + bytes_of_site * work.sites);
}

void planDrawingAfterSteps(MemoryPlan& plan, const Workload& work, const PictureOptions& picture,
                           const std::optional<Box>& domain, const DrawingNeeds& needs) {
  constexpr std::uint64_t gaps = 8'000'000;
  RenderOptions options = picture.render;
  if (domain) options.domain = *domain;
  const PictureSize size = domain ? sizeOf(picture, shownBox(options)) : sizeBefore(picture);
  options.width = size.width;
  options.height = size.height;
  plan.take("gaps that steps left", gaps);
  planColors(plan, work, picture);
  planDrawing(plan, work, options, needs, /*checks=*/false);
}

}  // namespace vorpipe::cli
