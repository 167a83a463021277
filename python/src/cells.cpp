#include <fmt/core.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "choices.h"
#include "errors.h"
#include "io/cells/cells_file.h"
#include "io/files/output_file.h"
#include "results.h"

namespace vorpipe::python {
namespace {

using Shared = std::shared_ptr<CellsResult>;

/// The property of a CellsResult that shows an array of its diagram.
template <class Number, class Row>
auto viewed(std::vector<Row> Diagram::*rows) {
  return [rows](const Shared& result) {
    return viewOf<Number>(result->diagram.*rows, std::shared_ptr<const CellsResult>(result));
  };
}

Result<void> writeFile(const CellsResult& result, const CellsFormat& format, const std::string& path) {
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  auto written = writeCells(*file, {result.input->sites, result.diagram}, format);
  return written ? file->commit() : written;
}

void save(const CellsResult& result, const std::string& path) {
  const CellsFormat& format = formatOf(result, path);
  auto written = [&] {
    const py::gil_scoped_release no_gil;
    return writeFile(result, format, path);
  }();
  valueOf(std::move(written));
}

}  // namespace

const CellsFormat& formatOf(const CellsResult& result, const std::string& path) {
  const CellsFormat& format = *valueOf(cellsFormatOf(path));
  if (format.detail > result.options.detail) {
    raiseInput("detail", fmt::format("{} takes cells that were computed with detail='{}'; these have '{}'",
                                     format.extension, nameIn(detail_choices, format.detail),
                                     nameIn(detail_choices, result.options.detail)));
  }
  return format;
}

void defineCells(py::module_& module) {
  py::class_<CellsResult, Shared>(module, "Cells", "The arrays of a diagram.")
      .def("__len__", [](const CellsResult& result) { return result.diagram.status.size(); })
      .def_property_readonly(
          "input", [](const CellsResult& result) { return std::const_pointer_cast<Input>(result.input); })
      .def_property_readonly(
          "detail", [](const CellsResult& result) { return nameIn(detail_choices, result.options.detail); })
      .def_property_readonly(
          "report",
          [](const Shared& result) { return std::shared_ptr<Report>(result, &result->diagram.report); })
      .def_property_readonly("status", viewed<std::uint8_t>(&Diagram::status))
      .def_property_readonly("owner", viewed<std::uint32_t>(&Diagram::owner))
      .def_property_readonly("areas", viewed<double>(&Diagram::area))
      .def_property_readonly("perimeters", viewed<double>(&Diagram::perimeter))
      .def_property_readonly("centroids", viewed<double>(&Diagram::centroid))
      .def_property_readonly("second_moments", viewed<double>(&Diagram::second_moments))
      // NumPy makes float64 of a sum of uint64 and int64, so that offsets have a sign.
      .def_property_readonly("offsets", viewed<std::int64_t>(&Diagram::cell_offsets))
      .def_property_readonly("vertices", viewed<double>(&Diagram::vertices))
      .def_property_readonly("neighbors", viewed<std::int64_t>(&Diagram::neighbors))
      .def_property_readonly("edge_lengths", viewed<double>(&Diagram::edge_lengths))
      .def_property_readonly("neighbor_shifts", viewed<std::int32_t>(&Diagram::neighbor_shifts))
      .def_property_readonly("ring_starts", viewed<std::int64_t>(&Diagram::ring_starts))
      .def_property_readonly("mass", viewed<double>(&Diagram::mass))
      .def_property_readonly("mass_centroids", viewed<double>(&Diagram::mass_centroid))
      .def_property_readonly("triangles", viewed<std::uint32_t>(&Diagram::triangles))
      .def("area_sum", [](const CellsResult& result) { return areaSum(result.diagram); })
      .def("save", &save, py::arg("path"));
  module.def("cells_extensions", &cellsExtensions);
}

}  // namespace vorpipe::python
