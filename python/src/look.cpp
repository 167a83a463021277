#include "look.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/try.h"
#include "choices.h"
#include "io/sites/attribute_values.h"
#include "results.h"
#include "vorpipe/globe.h"

namespace vorpipe::python {
namespace {

struct Colors {
  std::string by;
  std::optional<std::string> map;
  std::vector<std::string> own;
  std::optional<std::string> scale;
  std::optional<std::pair<double, double>> range;
  bool legend, fill;
};

/// What stands around a picture and in its cells, and the attributes that colors and labels show.
struct PictureWords {
  std::string title, legend_title, color, labels;
  bool legend_beside;
  SharedAttributes own;
};

PhotographFile photographIn(const std::string& path) {
  auto read = readPhotograph(path);
  if (!read && read.error().code == ErrorCode::input) raiseInput("color", read.error().message);
  return valueOf(std::move(read));
}

/// Width and height, or the longer side alone.
using SizeArguments = std::pair<int, std::optional<int>>;

Look lookOf(const std::optional<SizeArguments>& size, const std::optional<std::string>& fit,
            const Colors& colors, const PictureWords& words, const py::dict& marks, const std::string& search,
            int neighbors, const std::optional<std::array<double, 4>>& view,
            const std::optional<std::string>& map, const std::optional<std::array<double, 2>>& view_from) {
  Look look{};
  if (size && size->second) look.size = PictureSize{size->first, *size->second};
  if (size && !size->second) look.longer_side = size->first;
  RenderOptions& options = look.options;
  if (fit) look.fit = chosen<Fit>("fit", *fit);
  if (isPhotograph(colors.by)) {
    look.color_file = colors.by;
    look.photograph = photographIn(colors.by);
  } else {
    options.color = chosen<ColorBy>("color", colors.by);
  }
  options.colormap = colors.map.value_or("");
  for (const std::string& color : colors.own) options.colors.push_back(colorOf("colormap", color));
  options.title = words.title;
  options.legend_title = words.legend_title;
  options.legend_beside = words.legend_beside;
  look.color = words.color;
  look.labels = words.labels;
  look.own = words.own;
  if (colors.scale) options.color_scale = chosen("color_scale", *colors.scale, ColorScale::linear);
  if (colors.range) options.color_range = ColorRange{colors.range->first, colors.range->second};
  options.legend = colors.legend;
  options.fill = colors.fill;
  takeOptions(picture_rows, marks, options);
  options.search = {chosen<Search>("search", search), neighbors};
  if (view) options.view = Box{(*view)[0], (*view)[1], (*view)[2], (*view)[3]};
  if (map) look.map = chosen<GlobeMap>("map", *map);
  if (view_from) options.view_from = Point{(*view_from)[0], (*view_from)[1]};
  return look;
}

/// Returns the values given for an argument, or the attribute that it names; null: neither.
const Attribute* attributeFor(const Look& look, const Input& input, const std::string& argument,
                              const std::string& name) {
  if (look.own) {
    const auto has_name = [&](const Attribute& attribute) { return attribute.name() == argument; };
    const auto found = std::ranges::find_if(look.own->columns, has_name);
    if (found != look.own->columns.end()) return &*found;
  }
  if (name.empty()) return nullptr;
  static const std::vector<Attribute> none;
  const auto found = attributeNamed(input.attributes ? input.attributes->columns : none, name);
  if (!found) raiseInput(argument, found.error().message);
  return *found;
}

/// Takes what pictures of the globe alone have, and refuses what it has not.
void takeMap(const Look& look, const Input& input, RenderOptions& options) {
  options.globe = input.globe;
  if (look.map) options.map = *look.map;
  if (!input.globe) {
    if (look.map) raiseInput("map", "is for the globe");
    if (options.view_from) raiseInput("view_from", "is for the globe");
    return;
  }
  if (look.map && options.view_from) raiseInput("map", "view_from is a map of its own; leave one out");
  if (look.fit) raiseInput("fit", "is for a plane; maps of the globe keep their aspect");
  if (!look.color_file.empty()) raiseInput("color", "a photograph is for a plane, not for the globe");
  if (!options.view) options.view = valueOf(domainOnMap(options));
}

/// Names areas in square kilometers, where the unit is known.
void nameAreas(const Input& input, RenderOptions& options) {
  const auto unit = input.globe ? std::optional(1.0) : squareKilometersIn(input.system);
  if (!options.legend_beside || !options.legend_title.empty() || options.color != ColorBy::area || !unit)
    return;
  options.legend_title = areas_in_kilometers;
  options.legend_factor = *unit;
}

}  // namespace

RenderOptions renderOptionsOf(const Look& look, const Input& input) {
  RenderOptions options = look.options;
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  takeMap(look, input, options);
  const Box shown = shownBox(options);
  const PictureSize usual = look.longer_side > 0 ? sizeFor(shown, look.longer_side) : defaultSize(shown);
  const PictureSize size = look.size.value_or(usual);
  options.width = size.width;
  options.height = size.height;
  options.fit = input.globe ? Fit::letterbox : look.fit.value_or(usualFit(input));
  if (const Attribute* const attribute = attributeFor(look, input, "color", look.color)) {
    auto values = valuesOf(*attribute);
    if (!values) raiseInput("color", values.error().message);
    options.color = ColorBy::value;
    options.values = std::move(*values);
    options.values.title = look.color;
  }
  if (const Attribute* const attribute = attributeFor(look, input, "labels", look.labels)) {
    options.texts = textsOf(*attribute);
  }
  nameAreas(input, options);
  return options;
}

Result<void> takeColors(const Look& look, const Input& input, int threads, RenderOptions& options) {
  if (look.color_file.empty()) return {};
  PlacedSites placed;
  placed.domain = input.domain;
  placed.system = input.system;
  placed.projection = input.projection;
  VORPIPE_TRY(placePhotograph(look.photograph, look.color_file, placed, {}, "color", "color"));
  VORPIPE_VAR(colors, photographColors(input.sites, look.photograph.photograph,
                                       vorpipe::cellsOptions(options), threads));
  options.site_colors = std::move(colors);
  return {};
}

void defineLook(py::module_& module) {
  py::class_<Colors>(module, "Colors", "How cells are colored.")
      .def(py::init([](const std::string& by, const std::optional<std::string>& map,
                       const std::vector<std::string>& own, const std::optional<std::string>& scale,
                       const std::optional<std::pair<double, double>>& range, bool legend,
                       bool fill) { return Colors{by, map, own, scale, range, legend, fill}; }),
           py::arg("by"), py::arg("map"), py::arg("own"), py::arg("scale"), py::arg("range"),
           py::arg("legend"), py::arg("fill"));
  py::class_<PictureWords>(module, "Words", "The texts of a picture, and the attributes that it shows.")
      .def(py::init([](const std::string& title, const std::string& legend_title, const std::string& color,
                       const std::string& labels, bool legend_beside, const SharedAttributes& own) {
             return PictureWords{title, legend_title, color, labels, legend_beside, own};
           }),
           py::arg("title"), py::arg("legend_title"), py::arg("color"), py::arg("labels"),
           py::arg("legend_beside"), py::arg("own").none(true));
  module.attr("MARKS") = usualOptions<RenderOptions>(picture_rows);
  py::class_<Look>(module, "Look", "How a picture is to look.")
      .def(py::init(&lookOf), py::arg("size"), py::arg("fit"), py::arg("colors"), py::arg("words"),
           py::arg("marks"), py::arg("search"), py::arg("neighbors"), py::arg("view"), py::arg("map"),
           py::arg("view_from"));
}

}  // namespace vorpipe::python
