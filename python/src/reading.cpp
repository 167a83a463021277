/// What is found in cells once they are there: shared vertices and edges, the cells of places, the bytes of
/// files.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "arrays.h"
#include "errors.h"
#include "io/cells/cells_file.h"
#include "io/files/byte_sink.h"
#include "results.h"

namespace vorpipe::python {
namespace {

using SharedTopology = std::shared_ptr<Topology>;

/// The property of a Topology that shows one of its arrays.
template <class Number, class Row>
auto shown(std::vector<Row> Topology::*rows) {
  return [rows](const SharedTopology& topology) {
    return viewOf<Number>((*topology).*rows, std::shared_ptr<const Topology>(topology));
  };
}

SharedTopology topologyOfCells(const CellsResult& cells, int threads) {
  auto found = [&] {
    const py::gil_scoped_release no_gil;
    return topologyOf(cells.diagram, threads);
  }();
  return std::make_shared<Topology>(valueOf(std::move(found)));
}

/// The bytes of a file with that extension.
py::bytes bytesOf(const CellsResult& cells, const std::string& extension) {
  const CellsFormat& format = formatOf(cells, "cells" + extension);
  MemorySink sink(extension);
  auto written = [&] {
    const py::gil_scoped_release no_gil;
    return writeCells(sink, {cells.input->sites, cells.diagram}, format);
  }();
  valueOf(std::move(written));
  return sink.take();
}

std::shared_ptr<Locator> locatorOf(const CellsResult& cells, int threads) {
  auto made = [&] {
    const py::gil_scoped_release no_gil;
    return Locator::make(cells.input->sites, cellsOptionsOf(*cells.input), threads);
  }();
  return std::make_shared<Locator>(valueOf(std::move(made)));
}

/// Places are of shape (P, 2), without gaps.
py::array find(const Locator& locator, const py::array_t<double, py::array::c_style>& places) {
  const auto count = static_cast<std::size_t>(places.shape(0));
  std::vector<std::uint32_t> sites(count);
  const auto* first = reinterpret_cast<const Point*>(places.data());
  {
    const py::gil_scoped_release no_gil;
    locator.at({first, count}, sites);
  }
  return arrayOf<std::uint32_t>(std::move(sites));
}

}  // namespace

void defineReading(py::module_& module) {
  py::class_<Topology, SharedTopology>(module, "Topology", "The vertices and edges that cells share.")
      .def_property_readonly("vertices", shown<double>(&Topology::vertices))
      .def_property_readonly("vertex_of", shown<std::uint32_t>(&Topology::vertex_of))
      .def_property_readonly("edge_of", shown<std::uint32_t>(&Topology::edge_of))
      .def_property_readonly("edge_vertices", shown<std::uint32_t>(&Topology::edge_vertices))
      .def_property_readonly("edge_cells", shown<std::int64_t>(&Topology::edge_cells));
  py::class_<Locator, std::shared_ptr<Locator>>(module, "Locator",
                                                "Finds the points whose cells hold places.")
      .def("find", &find, py::arg("places"));
  module.def("topology_of", &topologyOfCells, py::arg("cells"), py::arg("threads"));
  module.def("locator_of", &locatorOf, py::arg("cells"), py::arg("threads"));
  module.def("bytes_of", &bytesOf, py::arg("cells"), py::arg("extension"));
}

}  // namespace vorpipe::python
