#include "input.h"

#include <fmt/core.h>
#include <pybind11/stl.h>

#include <cmath>

#include "arrays.h"
#include "choices.h"
#include "errors.h"

namespace vorpipe::python {
namespace {

/// Points by their index, whatever the strides. The GIL need not be held: the caller's reference keeps them.
void takePoints(const Numbers& points, std::vector<double>& x, std::vector<double>& y) {
  const auto elements = points.unchecked<2>();
  const auto count = static_cast<std::size_t>(elements.shape(0));
  const py::gil_scoped_release no_gil;
  x.resize(count);
  y.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    x[i] = elements(row, 0);
    y[i] = elements(row, 1);
  }
}

void refuseNotFinite(const Sites& sites) {
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (std::isfinite(sites.x[i]) && std::isfinite(sites.y[i])) continue;
    raiseInput("points", fmt::format("point {} is not finite: {}, {}", i, sites.x[i], sites.y[i]));
  }
}

Outline outlineOf(const OutlineArrays& arrays) {
  const auto& [points, rings, polygons] = arrays;
  const auto elements = points.unchecked<2>();
  Outline outline;
  outline.points.resize(static_cast<std::size_t>(elements.shape(0)));
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    outline.points[i] = {elements(row, 0), elements(row, 1)};
  }
  outline.ring_offsets = vectorOf(rings);
  outline.polygon_offsets = vectorOf(polygons);
  return outline;
}

Density densityOf(const Numbers& values) {
  const auto elements = values.unchecked<2>();
  Density density{static_cast<int>(elements.shape(1)), static_cast<int>(elements.shape(0)), {}};
  density.values.reserve(static_cast<std::size_t>(values.size()));
  for (py::ssize_t row = 0; row < elements.shape(0); ++row) {
    for (py::ssize_t column = 0; column < elements.shape(1); ++column) {
      density.values.push_back(elements(row, column));
    }
  }
  return density;
}

/// As the command line does, but for a domain that repeats: its period is no guess.
Box defaultDomain(const Input& input) {
  if (!input.outline.empty()) return boxOf(input.outline.points);
  if (input.periodic != Periodic::none) {
    raiseInput("domain", "a domain that repeats must be named: (xmin, ymin, xmax, ymax)");
  }
  const Box box = domainOf(input.sites);
  if (!std::isfinite(box.xmax - box.xmin) || !std::isfinite(box.ymax - box.ymin)) {
    raiseInput("domain", "the points reach too far for a default, name one: (xmin, ymin, xmax, ymax)");
  }
  return box;
}

py::array pointsOf(const Sites& sites) {
  std::vector<Point> points(sites.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {sites.x[i], sites.y[i]};
  py::array array = arrayOf<double>(std::move(points));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace

std::shared_ptr<const Input> inputOf(const Numbers& points, const std::optional<Numbers>& weights,
                                     const std::optional<std::array<double, 4>>& domain,
                                     const std::string& periodic, const std::optional<OutlineArrays>& outline,
                                     const std::optional<Numbers>& density) {
  auto input = std::make_shared<Input>();
  takePoints(points, input->sites.x, input->sites.y);
  if (input->sites.size() == 0) raiseInput("points", "there are none");
  refuseNotFinite(input->sites);
  if (weights) input->sites.weight = vectorOf(*weights);
  input->periodic = chosen("periodic", periodic_choices, periodic);
  if (outline) input->outline = outlineOf(*outline);
  if (density) input->density = densityOf(*density);
  input->domain =
      domain ? Box{(*domain)[0], (*domain)[1], (*domain)[2], (*domain)[3]} : defaultDomain(*input);
  return input;
}

void defineInput(py::module_& module) {
  // pybind11 holds no pointers to constants; nothing here changes one.
  py::class_<Input, std::shared_ptr<Input>>(module, "Input", "Points and where they have cells.")
      .def(py::init([](const Numbers& points, const std::optional<Numbers>& weights,
                       const std::optional<std::array<double, 4>>& domain, const std::string& periodic,
                       const std::optional<OutlineArrays>& outline, const std::optional<Numbers>& density) {
             return std::const_pointer_cast<Input>(
                 inputOf(points, weights, domain, periodic, outline, density));
           }),
           py::arg("points"), py::arg("weights"), py::arg("domain"), py::arg("periodic"), py::arg("outline"),
           py::arg("density"))
      .def("__len__", [](const Input& input) { return input.sites.size(); })
      .def_property_readonly("points", [](const Input& input) { return pointsOf(input.sites); })
      .def_property_readonly("weights",
                             [](const std::shared_ptr<Input>& input) -> std::optional<py::array> {
                               if (input->sites.weight.empty()) return std::nullopt;
                               return viewOf<double>(input->sites.weight,
                                                     std::shared_ptr<const Input>(input));
                             })
      .def_property_readonly("domain",
                             [](const Input& input) {
                               const Box& box = input.domain;
                               return std::array{box.xmin, box.ymin, box.xmax, box.ymax};
                             })
      .def_property_readonly("periodic",
                             [](const Input& input) { return nameIn(periodic_choices, input.periodic); })
      .def_property_readonly("has_outline", [](const Input& input) { return !input.outline.empty(); })
      .def_property_readonly("has_density", [](const Input& input) { return !input.density.values.empty(); });
}

}  // namespace vorpipe::python
