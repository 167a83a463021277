/// Sites that move, and sites that are drawn from a density.
#include <fmt/core.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <utility>

#include "arrays.h"
#include "choices.h"
#include "errors.h"
#include "input.h"
#include "io/cells/points_file.h"
#include "io/sites/sites_file.h"
#include "members.h"
#include "saving.h"
#include "session.h"
#include "vorpipe/stipple.h"

namespace vorpipe::python {
namespace {

using SharedRelaxed = std::shared_ptr<RelaxResult>;

/// The sites as the caller has them: in degrees where they are projected.
Sites shownSites(const RelaxResult& result) { return sitesInDegrees(*result.input, result.relaxed.sites); }

py::array relaxedPoints(const RelaxResult& result) { return pointsOf(shownSites(result)); }

/// The sites where they are now, for cells of the same domain.
std::shared_ptr<Input> movedInput(const RelaxResult& result) {
  auto input = std::make_shared<Input>(*result.input);
  input->sites = result.relaxed.sites;
  if (input->projection) {
    const Sites shown = shownSites(result);
    input->longitudes = shown.x;
    input->latitudes = shown.y;
  }
  return input;
}

/// A column of the trace.
auto traced(double RelaxStep::*member) {
  return [member](const RelaxResult& result) {
    std::vector<double> values;
    for (const RelaxStep& step : result.relaxed.trace) values.push_back(step.*member);
    return arrayOf<double>(std::move(values));
  };
}

void savePoints(const RelaxResult& result, const std::string& path) {
  const PointsFormat& format = *valueOf(pointsFormatOf(path));
  const Sites sites = shownSites(result);
  const Input& input = *result.input;
  PointsOutput output{sites, {}, input.projection ? input.degrees : input.system};
  if (input.attributes) output.attributes = input.attributes->columns;
  saveFile(path, input.files, [&](ByteSink& sink) { return writePoints(sink, output, format); });
}

py::array takenSteps(const RelaxResult& result) {
  py::array_t<bool> taken(static_cast<py::ssize_t>(result.relaxed.trace.size()));
  std::ranges::transform(result.relaxed.trace, taken.mutable_data(), &RelaxStep::taken);
  return taken;
}

py::array drawnPoints(const DensityArguments& density, const std::array<double, 4>& box, std::uint64_t count,
                      std::uint64_t seed) {
  if (count > max_sites) raiseInput("n", fmt::format("{} points of at most {}", count, max_sites));
  return pointsOf(valueOf(drawnFrom(densityOf(density), {box[0], box[1], box[2], box[3]}, {}, count, seed)));
}

}  // namespace

RelaxOptions relaxOptionsOf(const Input& input, const RelaxArguments& given) {
  RelaxOptions options = given.options;
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  options.globe = input.globe;
  options.density = input.density;
  options.search = {chosen<Search>("search", given.search), given.neighbors};
  return options;
}

void defineRelaxing(py::module_& module) {
  py::class_<RelaxArguments>(module, "RelaxArguments", "How sites move.")
      .def(py::init([](const py::dict& given, std::string search, int neighbors) {
             RelaxOptions options{};
             takeOptions(relax_rows, given, options);
             return RelaxArguments{std::move(options), std::move(search), neighbors};
           }),
           py::arg("options"), py::arg("search"), py::arg("neighbors"));
  module.attr("RELAX") = usualOptions<RelaxOptions>(relax_rows);
  py::class_<RelaxResult, SharedRelaxed>(module, "Relaxed", "Sites that have moved.")
      .def_property_readonly("points", &relaxedPoints)
      .def_property_readonly("energy", traced(&RelaxStep::energy))
      .def_property_readonly("hexagonal", traced(&RelaxStep::hexagonal))
      .def_property_readonly("farthest", traced(&RelaxStep::farthest))
      .def_property_readonly("seconds", traced(&RelaxStep::seconds))
      .def_property_readonly("taken", &takenSteps)
      .def_property_readonly("end", [](const RelaxResult& result) { return nameOf(result.relaxed.end); })
      .def_property_readonly("report",
                             [](const SharedRelaxed& result) {
                               return std::shared_ptr<Report>(result, &result->relaxed.report);
                             })
      .def_property_readonly(
          "input", [](const RelaxResult& result) { return std::const_pointer_cast<Input>(result.input); })
      .def_property_readonly("moved", &movedInput)
      .def("save", &savePoints, py::arg("path"))
      .def(pickles<RelaxResult>());
  module.def("drawn_points", &drawnPoints, py::arg("density"), py::arg("box"), py::arg("n"), py::arg("seed"));
}

}  // namespace vorpipe::python
