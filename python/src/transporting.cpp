/// Weights for masses that are prescribed.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <utility>

#include "arrays.h"
#include "choices.h"
#include "errors.h"
#include "io/cells/points_file.h"
#include "members.h"
#include "saving.h"
#include "session.h"

namespace vorpipe::python {
namespace {

using SharedTransport = std::shared_ptr<TransportResult>;

template <class Value>
py::array copyOf(const std::vector<Value>& values) {
  return arrayOf<double>(std::vector<Value>(values));
}

py::array centroidsOf(const TransportResult& result) {
  std::vector<Point> places = result.found.cells.centroid;
  const auto& projection = result.input->projection;
  for (Point& place : places) place = projection ? projection->toDegrees(place) : place;
  return arrayOf<double>(std::move(places));
}

py::array traceOf(const TransportResult& result) {
  py::array_t<TransportStep> rows(static_cast<py::ssize_t>(result.found.trace.size()));
  std::ranges::copy(result.found.trace, rows.mutable_data());
  return rows;
}

void saveWeighted(const TransportResult& result, const std::string& path) {
  const PointsFormat& format = *valueOf(pointsFormatOf(path));
  const Input& input = *result.input;
  const Sites sites = sitesInDegrees(input, result.found.sites);
  PointsOutput output{sites, {}, input.projection ? input.degrees : input.system};
  if (input.attributes) output.attributes = input.attributes->columns;
  saveFile(path, input.files, [&](ByteSink& sink) { return writePoints(sink, output, format); });
}

/// The sites with their weights, for cells of the same surface.
std::shared_ptr<Input> weightedInput(const TransportResult& result) {
  auto input = std::make_shared<Input>(*result.input);
  input->sites = result.found.sites;
  input->surface = result.surface;
  return input;
}

[[noreturn]] void refuse(const char* message) { raise({ErrorCode::input, message}); }

template <class Value>
auto ofStep(Value TransportStep::*member) {
  return [member](const TransportStep& step) { return step.*member; };
}

}  // namespace

TransportOptions transportOptionsOf(const Input& input, const TransportArguments& given) {
  if (given.fill && !(*given.fill > 0 && *given.fill < 1)) {
    refuse("fill: must be a part of the domain, between 0 and 1");
  }
  if (given.normalize && (given.free_surface || given.fill)) {
    refuse("normalize: cells with a free surface do not fill the domain; fill scales them");
  }
  TransportOptions options = given.options;
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  options.density = input.density;
  options.surface = given.free_surface || given.fill ? Surface::free : Surface::none;
  options.search = {chosen<Search>("search", given.search), given.neighbors};
  options.masses = given.masses;
  return options;
}

void defineTransporting(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(TransportStep, diagram, newton, length, taken, norm, worst, least, linear_iterations,
                       seconds);
  py::class_<TransportStep>(module, "TransportStep", "One diagram of a transport.")
      .def_property_readonly("diagram", ofStep(&TransportStep::diagram))
      .def_property_readonly("newton", ofStep(&TransportStep::newton))
      .def_property_readonly("length", ofStep(&TransportStep::length))
      .def_property_readonly("taken", ofStep(&TransportStep::taken))
      .def_property_readonly("norm", ofStep(&TransportStep::norm))
      .def_property_readonly("worst", ofStep(&TransportStep::worst))
      .def_property_readonly("least", ofStep(&TransportStep::least))
      .def_property_readonly("linear_iterations", ofStep(&TransportStep::linear_iterations))
      .def_property_readonly("seconds", ofStep(&TransportStep::seconds))
      .def(pickles<TransportStep>());
  py::class_<TransportArguments>(module, "TransportArguments", "Which masses cells are to have.")
      .def(py::init([](std::vector<double> masses, bool normalize, std::optional<double> fill,
                       bool free_surface, const py::dict& options, std::string search, int neighbors) {
             TransportArguments made{std::move(masses), normalize, fill, free_surface, {},
                                     std::move(search), neighbors};
             takeOptions(transport_rows, options, made.options);
             return made;
           }),
           py::kw_only(), py::arg("masses"), py::arg("normalize"), py::arg("fill"), py::arg("free_surface"),
           py::arg("options"), py::arg("search"), py::arg("neighbors"));
  module.attr("TRANSPORT") = usualOptions<TransportOptions>(transport_rows);
  py::class_<TransportResult, SharedTransport>(module, "Transported", "Weights that give cells their masses.")
      .def_property_readonly("weights",
                             [](const TransportResult& result) { return copyOf(result.found.sites.weight); })
      .def_property_readonly("masses",
                             [](const TransportResult& result) { return copyOf(result.found.cells.mass); })
      .def_property_readonly("areas",
                             [](const TransportResult& result) { return copyOf(result.found.cells.area); })
      .def_property_readonly("centroids", &centroidsOf)
      .def_property_readonly("trace", &traceOf)
      .def_property_readonly("cost", [](const TransportResult& result) { return result.found.cost; })
      .def_property_readonly("end", [](const TransportResult& result) { return nameOf(result.found.end); })
      .def_property_readonly("report",
                             [](const SharedTransport& result) {
                               return std::shared_ptr<Report>(result, &result->found.report);
                             })
      .def_property_readonly(
          "input", [](const TransportResult& result) { return std::const_pointer_cast<Input>(result.input); })
      .def_property_readonly("weighted", &weightedInput)
      .def_property_readonly("free_surface",
                             [](const TransportResult& result) { return result.surface == Surface::free; })
      .def("save", &saveWeighted, py::arg("path"))
      .def(pickles<TransportResult>());
}

}  // namespace vorpipe::python
