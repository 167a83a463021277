/// The module _vorpipe: the C++ interface for the package in python/vorpipe, which says what each is for.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <stdexcept>

#include "flowing.h"
#include "input.h"
#include "results.h"
#include "session.h"
#include "space.h"
#include "vorpipe.h"
#include "watch.h"

namespace vorpipe::python {
namespace {

/// Types of arrays have another layout in NumPy 2, which pybind11 knows from 2.12 on.
void refuseUnknownNumpy() {
  if constexpr (PYBIND11_VERSION_MAJOR > 2 || PYBIND11_VERSION_MINOR >= 12) return;
  const auto numpy = py::module_::import("numpy");
  const auto version = numpy.attr("__version__").cast<std::string>();
  if (std::stoi(version) < 2) return;
  throw std::runtime_error(
      fmt::format("NumPy {} of {} is too new for this vorpipe, which takes NumPy before 2: "
                  "pip install \"numpy<2\"",
                  version, py::str(numpy.attr("__path__")[py::int_(0)]).cast<std::string>()));
}

}  // namespace
}  // namespace vorpipe::python

PYBIND11_MODULE(_vorpipe, module) {
  using namespace vorpipe::python;
  refuseUnknownNumpy();
  module.doc() = "What the package vorpipe is made of; import that.";
  module.attr("__version__") = std::string(vorpipe::version());
  module.attr("LARGEST_SIDE") = vorpipe::largest_side;
  module.attr("NO_SITE") = vorpipe::no_site;
  module.attr("WALLS") =
      py::make_tuple(vorpipe::wall_xmin, vorpipe::wall_xmax, vorpipe::wall_ymin, vorpipe::wall_ymax,
                     vorpipe::wall_outline, vorpipe::wall_zmin, vorpipe::wall_zmax);
  defineAttributes(module);
  defineTable(module);
  defineInput(module);
  defineReport(module);
  defineCells(module);
  defineReading(module);
  defineLook(module);
  definePicture(module);
  defineDevices(module);
  defineRelaxing(module);
  defineTransporting(module);
  defineSession(module);
  defineSpace(module);
  defineFlowing(module);
  defineJudgment(module);
  defineForecast(module);
  defineSelftest(module);
  defineFiles(module);
  defineTriangles(module);
  module.def("says_stop", &saysStop, py::arg("answer"));
  module.def("end_runs", &endRuns);
  module.def("forget_runs", &forgetRuns);
  registerErrors();
}
