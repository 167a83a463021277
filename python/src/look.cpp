#include "look.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <string>
#include <utility>

#include "base/try.h"
#include "choices.h"
#include "results.h"

namespace vorpipe::python {
namespace {

struct Colors {
  std::string by, map;
  std::optional<std::string> scale;
  std::optional<std::pair<double, double>> range;
  bool legend, fill;
};

PhotographFile photographIn(const std::string& path) {
  auto read = readPhotograph(path);
  if (!read && read.error().code == ErrorCode::input) raiseInput("color", read.error().message);
  return valueOf(std::move(read));
}

/// Width and height, or the longer side alone.
using SizeArguments = std::pair<int, std::optional<int>>;

Look lookOf(const std::optional<SizeArguments>& size, const std::optional<std::string>& fit,
            const Colors& colors, const py::dict& marks, const std::string& search, int neighbors,
            const std::optional<std::array<double, 4>>& view) {
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
  options.colormap = colors.map;
  if (colors.scale) options.color_scale = chosen("color_scale", *colors.scale, ColorScale::linear);
  if (colors.range) options.color_range = ColorRange{colors.range->first, colors.range->second};
  options.legend = colors.legend;
  options.fill = colors.fill;
  takeOptions(picture_rows, marks, options);
  options.search = {chosen<Search>("search", search), neighbors};
  if (view) options.view = Box{(*view)[0], (*view)[1], (*view)[2], (*view)[3]};
  return look;
}

}  // namespace

RenderOptions renderOptionsOf(const Look& look, const Input& input) {
  RenderOptions options = look.options;
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  const Box shown = shownBox(options);
  const PictureSize usual = look.longer_side > 0 ? sizeFor(shown, look.longer_side) : defaultSize(shown);
  const PictureSize size = look.size.value_or(usual);
  options.width = size.width;
  options.height = size.height;
  options.fit = look.fit.value_or(usualFit(input));
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
      .def(py::init([](const std::string& by, const std::string& map, const std::optional<std::string>& scale,
                       const std::optional<std::pair<double, double>>& range, bool legend,
                       bool fill) { return Colors{by, map, scale, range, legend, fill}; }),
           py::arg("by"), py::arg("map"), py::arg("scale"), py::arg("range"), py::arg("legend"),
           py::arg("fill"));
  module.attr("MARKS") = usualOptions<RenderOptions>(picture_rows);
  py::class_<Look>(module, "Look", "How a picture is to look.")
      .def(py::init(&lookOf), py::arg("size"), py::arg("fit"), py::arg("colors"), py::arg("marks"),
           py::arg("search"), py::arg("neighbors"), py::arg("view"));
}

}  // namespace vorpipe::python
