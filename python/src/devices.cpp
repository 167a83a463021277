#include <fmt/core.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <map>

#include "errors.h"
#include "results.h"
#include "runs.h"
#include "session_options.h"

namespace vorpipe::python {
namespace {

std::vector<DeviceInfo> allDevices(const MaskArguments& mask) {
  const WithoutGil no_gil;
  return devices(Mask{mask.first, mask.second});
}

std::string lineOf(const DeviceInfo& info) {
  return fmt::format("<{}: {}>", info.backend, info.usable ? info.name : info.reason);
}

template <class Value>
std::map<std::string, Value> mapOf(const std::vector<std::pair<std::string, Value>>& pairs) {
  return {pairs.begin(), pairs.end()};
}

}  // namespace

void defineDevices(py::module_& module) {
  py::class_<DeviceInfo>(module, "DeviceInfo", "One device of one backend, usable or not.")
      .def_readonly("backend", &DeviceInfo::backend)
      .def_readonly("name", &DeviceInfo::name)
      .def_readonly("driver", &DeviceInfo::driver)
      .def_readonly("type", &DeviceInfo::type, "discrete, integrated, virtual, cpu or other.")
      .def_readonly("usable", &DeviceInfo::usable)
      .def_readonly("reason", &DeviceInfo::reason, "Why it cannot be used; empty where it can.")
      .def_property_readonly("features", [](const DeviceInfo& info) { return mapOf(info.features); })
      .def_property_readonly("limits", [](const DeviceInfo& info) { return mapOf(info.limits); })
      .def("__repr__", &lineOf);
  py::class_<Arithmetic>(module, "Arithmetic", "How a device rounds; errors are in units in the last place.")
      .def_readonly("quotient", &Arithmetic::quotient)
      .def_readonly("root", &Arithmetic::root)
      .def_readonly("inverse_root", &Arithmetic::inverse_root)
      .def_readonly("product", &Arithmetic::product)
      .def_readonly("sum", &Arithmetic::sum)
      .def_readonly("offset", &Arithmetic::offset)
      .def_readonly("fuses", &Arithmetic::fuses)
      .def_readonly("fuses_precise", &Arithmetic::fuses_precise)
      .def_readonly("keeps_denormals", &Arithmetic::keeps_denormals)
      .def_readonly("subpixel_bits", &Arithmetic::subpixel_bits);
  module.def("devices", &allDevices, py::arg("mask"));
  module.def("backend_names", &backendNames);
  module.def("feature_names", &featureNames);
  module.def("limit_names", &limitNames);
}

}  // namespace vorpipe::python
