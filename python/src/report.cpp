#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>

#include "members.h"
#include "results.h"

namespace vorpipe::python {
namespace {

/// Milliseconds by stage; those that were measured.
py::dict timesOf(const Report& report) {
  const Times& times = report.time_ms;
  py::dict stages;
  for (const auto& [stage, time] : {std::pair{"order", times.order}, std::pair{"upload", times.upload},
                                    std::pair{"search", times.search}, std::pair{"cells", times.cells},
                                    std::pair{"draw", times.draw}, std::pair{"download", times.download}}) {
    if (time >= 0) stages[stage] = time;
  }
  return stages;
}

/// Name and milliseconds of each.
std::vector<std::pair<std::string, double>> pipelinesOf(const Report& report) {
  std::vector<std::pair<std::string, double>> pipelines;
  for (const PipelineTime& made : report.pipelines) pipelines.emplace_back(made.name, made.milliseconds);
  return pipelines;
}

}  // namespace

void defineReport(py::module_& module) {
  py::class_<Report, std::shared_ptr<Report>>(module, "Report", "What a run did.")
      .def_readonly("backend", &Report::backend)
      .def_readonly("device", &Report::device)
      .def_readonly("driver", &Report::driver)
      .def_readonly("ok", &Report::ok, "Sites with a cell.")
      .def_readonly("empty", &Report::empty, "Sites that no place in the domain is nearest to.")
      .def_readonly("duplicate", &Report::duplicate, "Sites at another one's position.")
      .def_readonly("hidden", &Report::hidden, "Sites that heavier ones leave no cell; among the empty.")
      .def_readonly("retried", &Report::retried, "Cells that the device was asked for again.")
      .def_readonly("in_double", &Report::in_double, "Cells that were found in double on the processor.")
      .def_readonly("exact", &Report::exact, "Cells that were found in exact arithmetic.")
      .def_readonly("pixels", &Report::pixels, "Pixels that got their nearest site in double.")
      .def_property_readonly("time_ms", &timesOf, "Milliseconds by stage.")
      .def_property_readonly("pipelines", &pipelinesOf,
                             "Pipelines of shaders that were made for it: name and milliseconds of each.")
      .def_readonly("notes", &Report::notes, "What did not go as it began, a line each.")
      .def_readonly("validation_messages", &Report::validation_messages)
      .def(pickles<Report>());
}

}  // namespace vorpipe::python
