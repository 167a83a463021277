#include "vorpipe/selftest.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "errors.h"
#include "results.h"
#include "session_options.h"
#include "watch.h"

namespace vorpipe::python {
namespace {

SelftestReport runSelftest(const std::string& backend, const std::string& device, bool quick,
                           std::uint64_t seed, int threads, const MaskArguments& mask,
                           const py::object& progress) {
  SelftestOptions options;
  options.backend = backend;
  options.device = device;
  options.quick = quick;
  options.seed = seed;
  options.threads = threads;
  options.mask = {mask.first, mask.second};
  return valueOf(watched<SelftestReport>(progress, [options](Watch& watch) mutable {
    options.progress = progressOf(watch);
    return selftest(options);
  }));
}

}  // namespace

void defineSelftest(py::module_& module) {
  py::class_<SelftestRun>(module, "SelftestRun", "What became of one scene on one device.")
      .def_readonly("group", &SelftestRun::group)
      .def_readonly("scene", &SelftestRun::scene)
      .def_readonly("masked", &SelftestRun::masked, "What the device was made to lack.")
      .def_readonly("sites", &SelftestRun::sites)
      .def_readonly("seed", &SelftestRun::seed)
      .def_readonly("milliseconds", &SelftestRun::milliseconds)
      .def_readonly("notes", &SelftestRun::notes)
      .def_readonly("fault", &SelftestRun::fault, "The first promise that was broken; empty if none.")
      .def_property_readonly("passed", &SelftestRun::passed);
  py::class_<SelftestDevice>(module, "SelftestDevice", "One device, and what became of each scene on it.")
      .def_readonly("info", &SelftestDevice::info)
      .def_readonly("index", &SelftestDevice::index)
      .def_readonly("validated", &SelftestDevice::validated)
      .def_readonly("not_validated", &SelftestDevice::not_validated)
      .def_readonly("runs", &SelftestDevice::runs)
      .def_readonly("arithmetic", &SelftestDevice::arithmetic)
      .def_readonly("arithmetic_fault", &SelftestDevice::arithmetic_fault)
      .def_property_readonly("passed", &SelftestDevice::passed);
  py::class_<SelftestReport>(module, "SelftestReport", "What vorpipe found out about this machine.")
      .def_readonly("seed", &SelftestReport::seed)
      .def_readonly("quick", &SelftestReport::quick)
      .def_readonly("devices", &SelftestReport::devices)
      .def_readonly("milliseconds", &SelftestReport::milliseconds)
      .def_property_readonly("passed", &SelftestReport::passed);
  module.def("selftest", &runSelftest, py::arg("backend"), py::arg("device"), py::arg("quick"),
             py::arg("seed"), py::arg("threads"), py::arg("mask"), py::arg("progress"));
}

}  // namespace vorpipe::python
