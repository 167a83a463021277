/// What a run is about, once its arrays were taken from Python.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "attributes.h"
#include "io/sites/site_domain.h"
#include "systems.h"
#include "table.h"
#include "vorpipe.h"

namespace vorpipe::python {

namespace py = pybind11;

/// Never changed after it was made: runs on several threads may share one, and results keep it. With a
/// projection, sites and domain are in its plane.
struct Input : PlacedSites {
  Surface surface = Surface::none;
  Density density{};
  SharedAttributes attributes{};     ///< may be null
  std::vector<std::string> files{};  ///< that it was read from, which nothing of it is to replace
};

using Numbers = py::array_t<double>;
/// Points (M, 2), where their rings begin and end, and where polygons begin and end among the rings; the file
/// that they are of; their coordinate system.
using OutlineArrays = std::tuple<Numbers, py::array_t<std::uint64_t>, py::array_t<std::uint64_t>, std::string,
                                 std::optional<SystemArguments>>;

/// What a domain is asked for with.
struct DomainArguments {
  std::optional<std::array<double, 4>> box;
  bool hull;
  std::optional<OutlineArrays> outline;
  std::optional<std::pair<double, bool>> margin;  ///< whether it is relative to the longer side
  bool repair;
  bool project;
  std::optional<std::array<double, 2>> center;  ///< of the projection
  bool globe;
};

/// The sites of a run: of a table, or points (N, 2), as vorpipe/_arguments.py has seen to.
using GivenPoints = std::variant<std::shared_ptr<Table>, Numbers>;

/// Weights are of shape (N,). Errors: no points, or not finite; two kinds of weights; those of findDomain, in
/// the words of Python.
std::shared_ptr<Input> inputOf(const GivenPoints& points, const std::optional<Numbers>& weights,
                               const DomainArguments& domain, const std::string& periodic,
                               const std::optional<SystemArguments>& system);

Outline outlineOf(const OutlineArrays& arrays);

/// From xmin, ymin, xmax, ymax.
Box boxFrom(const std::array<double, 4>& box);

/// Points (N, 2) by their index, whatever the strides. Errors: none, or not finite.
Sites sitesOf(const Numbers& points);

/// A density: values of shape (height, width), rows from the top; where they lie; the file that they are of,
/// empty where there is none; the coordinate system of that place.
using DensityArguments =
    std::tuple<Numbers, std::optional<std::array<double, 4>>, std::string, std::optional<SystemArguments>>;
Density densityOf(const DensityArguments& given);

void defineInput(py::module_& module);

}  // namespace vorpipe::python
