/// What a run is about, once its arrays were taken from Python.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "vorpipe.h"

namespace vorpipe::python {

namespace py = pybind11;

/// Never changed after it was made: runs on several threads may share one, and results keep it.
struct Input {
  Sites sites;
  Box domain;
  Outline outline;
  Periodic periodic = Periodic::none;
  Density density;
};

using Numbers = py::array_t<double>;
/// Points (M, 2), where their rings begin and end, and where polygons begin and end among the rings.
using OutlineArrays = std::tuple<Numbers, py::array_t<std::uint64_t>, py::array_t<std::uint64_t>>;

/// Arrays have the shapes that their names say, which vorpipe/_arguments.py has seen to: points (N, 2),
/// weights (N,), density (H, W). Errors: no points, or not finite; no domain that could stand in for none.
std::shared_ptr<const Input> inputOf(const Numbers& points, const std::optional<Numbers>& weights,
                                     const std::optional<std::array<double, 4>>& domain,
                                     const std::string& periodic, const std::optional<OutlineArrays>& outline,
                                     const std::optional<Numbers>& density);

void defineInput(py::module_& module);

}  // namespace vorpipe::python
