#include "look.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <string>
#include <utility>

#include "choices.h"
#include "results.h"

namespace vorpipe::python {
namespace {

struct Colors {
  std::string by, map;
  std::optional<std::string> scale;
  std::optional<std::pair<double, double>> range;
  bool legend;
};

struct Marks {
  bool edges, show_sites, dual, labels, fill;
  double edge_width, dot_size, label_size;
  int antialias;
};

Look lookOf(const std::optional<std::pair<int, int>>& size, const std::optional<std::string>& fit,
            const Colors& colors, const Marks& marks, const std::string& search, int neighbors,
            const std::optional<std::array<double, 4>>& view) {
  Look look;
  if (size) look.size = PictureSize{size->first, size->second};
  RenderOptions& options = look.options;
  if (fit) look.fit = chosen("fit", fit_choices, *fit);
  options.color = chosen("color", color_choices, colors.by);
  options.colormap = colors.map;
  if (colors.scale) options.color_scale = chosen("color_scale", scale_choices, *colors.scale);
  if (colors.range) options.color_range = ColorRange{colors.range->first, colors.range->second};
  options.legend = colors.legend;
  options.edges = marks.edges;
  options.show_sites = marks.show_sites;
  options.dual = marks.dual;
  options.labels = marks.labels;
  options.fill = marks.fill;
  options.edge_width = marks.edge_width;
  options.dot_size = marks.dot_size;
  options.label_size = marks.label_size;
  options.antialias = marks.antialias;
  options.search = {chosen("search", search_choices, search), neighbors};
  if (view) options.view = Box{(*view)[0], (*view)[1], (*view)[2], (*view)[3]};
  return look;
}

}  // namespace

RenderOptions renderOptionsOf(const Look& look, const Input& input) {
  RenderOptions options = look.options;
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  const PictureSize size = look.size.value_or(defaultSize(shownBox(options)));
  options.width = size.width;
  options.height = size.height;
  options.fit = look.fit.value_or(usualFit(input));
  return options;
}

void defineLook(py::module_& module) {
  py::class_<Colors>(module, "Colors", "How cells are colored.")
      .def(py::init([](const std::string& by, const std::string& map, const std::optional<std::string>& scale,
                       const std::optional<std::pair<double, double>>& range, bool legend) {
             return Colors{by, map, scale, range, legend};
           }),
           py::arg("by"), py::arg("map"), py::arg("scale"), py::arg("range"), py::arg("legend"));
  py::class_<Marks>(module, "Marks", "What is drawn over cells.")
      .def(py::init([](bool edges, bool show_sites, bool dual, bool labels, bool fill, double edge_width,
                       double dot_size, double label_size, int antialias) {
             return Marks{edges, show_sites, dual, labels, fill, edge_width, dot_size, label_size, antialias};
           }),
           py::kw_only(), py::arg("edges"), py::arg("show_sites"), py::arg("dual"), py::arg("labels"),
           py::arg("fill"), py::arg("edge_width"), py::arg("dot_size"), py::arg("label_size"),
           py::arg("antialias"));
  py::class_<Look>(module, "Look", "How a picture is to look.")
      .def(py::init(&lookOf), py::arg("size"), py::arg("fit"), py::arg("colors"), py::arg("marks"),
           py::arg("search"), py::arg("neighbors"), py::arg("view"));
}

}  // namespace vorpipe::python
