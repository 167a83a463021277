/// What is found in cells once they are there: shared vertices and edges, the cells of places, the bytes of
/// files.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
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
    return topologyOf(cells.shown(), threads);
  }();
  return std::make_shared<Topology>(valueOf(std::move(found)));
}

/// The bytes of a file with that extension.
py::bytes bytesOf(const CellsResult& cells, const std::string& extension, bool only_cells) {
  const CellsFormat& format = formatOf(cells, "cells" + extension, only_cells);
  MemorySink sink(extension);
  auto written = [&] {
    const py::gil_scoped_release no_gil;
    return writeCells(sink, outputOf(cells, only_cells), format);
  }();
  valueOf(std::move(written));
  return sink.take();
}

/// Finds cells by places as the caller has them.
struct PlaceFinder {
  std::shared_ptr<const Input> input;
  Locator locator;
};

std::shared_ptr<PlaceFinder> locatorOf(const CellsResult& cells, int threads) {
  auto made = [&] {
    const py::gil_scoped_release no_gil;
    return Locator::make(cells.input->sites, cellsOptionsOf(*cells.input), threads);
  }();
  return std::make_shared<PlaceFinder>(PlaceFinder{cells.input, valueOf(std::move(made))});
}

/// Places are of shape (P, 2), without gaps; in degrees, if the cells are of a projection.
py::array find(const PlaceFinder& finder, const py::array_t<double, py::array::c_style>& places) {
  const auto count = static_cast<std::size_t>(places.shape(0));
  std::vector<std::uint32_t> sites(count);
  const auto* first = reinterpret_cast<const Point*>(places.data());
  {
    const py::gil_scoped_release no_gil;
    if (const auto& projection = finder.input->projection) {
      std::vector<Point> in_plane(count);
      std::transform(first, first + count, in_plane.begin(),
                     [&](const Point& place) { return projection->toPlane(place); });
      finder.locator.at(in_plane, sites);
    } else {
      finder.locator.at({first, count}, sites);
    }
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
  py::class_<PlaceFinder, std::shared_ptr<PlaceFinder>>(module, "Locator",
                                                        "Finds the points whose cells hold places.")
      .def("find", &find, py::arg("places"));
  module.def("topology_of", &topologyOfCells, py::arg("cells"), py::arg("threads"));
  module.def("locator_of", &locatorOf, py::arg("cells"), py::arg("threads"));
  module.def("bytes_of", &bytesOf, py::arg("cells"), py::arg("extension"), py::arg("only_cells"));
}

}  // namespace vorpipe::python
