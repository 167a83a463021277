/// What is found in cells once they are there: shared vertices and edges, the cells of places, the bytes of
/// files.
#include <fmt/core.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "errors.h"
#include "io/base/byte_sink.h"
#include "io/cells/cell_polygons.h"
#include "io/cells/cells_file.h"
#include "members.h"
#include "natural_neighbors.h"
#include "results.h"
#include "runs.h"
#include "vorpipe/free_surface.h"

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

/// The polygons of a cell as files of features have them, each a list of rings (M, 2).
py::list polygonsOf(const CellsResult& cells, std::uint64_t site) {
  py::list polygons;
  const CellPolygons found(cells.sites(), cells.shown(), site, cells.system());
  for (std::size_t p = 0; p < found.size(); ++p) {
    py::list rings;
    for (const auto ring : found[p])
      rings.append(arrayOf<double>(std::vector<Point>(ring.begin(), ring.end())));
    polygons.append(rings);
  }
  return polygons;
}

SharedTopology topologyOfCells(const CellsResult& cells, int threads) {
  auto found = [&] {
    const WithoutGil no_gil;
    return topologyOf(cells, threads);
  }();
  auto topology = std::make_shared<Topology>(valueOf(std::move(found)));
  if (std::max(topology->vertices.size(), topology->edge_cells.size()) >
      std::numeric_limits<std::int32_t>::max()) {
    raiseInput("topology", fmt::format("{} edges are more than indices of 32 bits with a sign tell apart",
                                       topology->edge_cells.size()));
  }
  return topology;
}

/// The bytes of a file with that extension.
py::bytes bytesOf(const CellsResult& cells, const std::string& extension, bool only_cells) {
  const std::string name = "cells" + extension;
  const CellsFormat& format = formatOf(cells, name, only_cells);
  MemorySink sink(extension);
  auto written = [&] {
    const WithoutGil no_gil;
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
    const WithoutGil no_gil;
    return Locator::make(cells.input->sites, cellsOptionsOf(*cells.input), threads);
  }();
  return std::make_shared<PlaceFinder>(PlaceFinder{cells.input, valueOf(std::move(made))});
}

/// Of a free surface: takes away sites whose discs do not reach their places.
void leaveOutAir(const Sites& sites, std::span<const Point> places, std::vector<std::uint32_t>& found) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::uint32_t i = found[k];
    if (i == no_site) continue;
    const double dx = places[k].x - sites.x[i], dy = places[k].y - sites.y[i];
    if (sites.weight.empty() || dx * dx + dy * dy > sites.weight[i]) found[k] = no_site;
  }
}

/// Of shape (P, 2), without gaps; in degrees, if the cells are of a projection.
using Places = py::array_t<double, py::array::c_style>;

std::span<const Point> spanOf(const Places& places) {
  return {reinterpret_cast<const Point*>(places.data()), static_cast<std::size_t>(places.shape(0))};
}

/// Where they are in the plane of the cells; `room` is for those that a projection takes there.
std::span<const Point> inPlane(const Input& input, std::span<const Point> places, std::vector<Point>& room) {
  if (!input.projection) return places;
  room.resize(places.size());
  std::ranges::transform(places, room.begin(),
                         [&](const Point& place) { return input.projection->toPlane(place); });
  return room;
}

py::array find(const PlaceFinder& finder, const Places& places) {
  const std::span<const Point> given = spanOf(places);
  std::vector<std::uint32_t> sites(given.size());
  {
    const WithoutGil no_gil;
    std::vector<Point> room;
    const std::span<const Point> in_plane = inPlane(*finder.input, given, room);
    finder.locator.at(in_plane, sites);
    if (finder.input->surface == Surface::free) leaveOutAir(finder.input->sites, in_plane, sites);
  }
  return arrayOf<std::int64_t>(std::vector<std::int64_t>(sites.begin(), sites.end()));
}

/// Where the rows of places begin, the sites in them and their weights.
std::tuple<py::array, py::array, py::array> naturalNeighborsOf(const CellsResult& cells, const Places& places,
                                                               int threads) {
  const Sites& sites = cells.input->sites;
  const auto differs = [&](double weight) { return weight != sites.weight.front(); };
  if (cells.options.periodic != Periodic::none) {
    raiseInput("periodic", "natural neighbors are those of a plane that does not repeat itself");
  }
  if (std::ranges::any_of(sites.weight, differs)) {
    raiseInput("weights", "natural neighbors are of points without weights");
  }
  requireDetail(cells, "natural_neighbors", Detail::everything);
  const std::span<const Point> given = spanOf(places);
  NaturalNeighbors found = [&] {
    const WithoutGil no_gil;
    const std::vector<Point> points = pointsIn(sites);
    const auto adjacent = adjacentTriangles(cells.diagram.triangles, points.size());
    const Delaunay mesh{flipped(points, cells.diagram.triangles, adjacent, true), points};
    std::vector<Point> room;
    return naturalNeighbors(mesh, inPlane(*cells.input, given, room), threads);
  }();
  return {arrayOf<std::int64_t>(std::move(found.offsets)), arrayOf<std::int32_t>(std::move(found.sites)),
          arrayOf<double>(std::move(found.weights))};
}

/// The line around a cell of a free surface, in the plane: from, to, the angle of an arc, whose it is.
py::list borderOfCell(const CellsResult& cells, std::size_t site) {
  if (cells.input->surface != Surface::free) raiseInput("surface", "the cells have none that is free");
  const Sites& sites = cells.input->sites;
  if (site >= sites.size()) throw py::index_error(fmt::format("there is no cell {}", site));
  py::list parts;
  for (const BorderPart& part : borderOf(Cell(cells.diagram, site), {sites.x[site], sites.y[site]})) {
    const auto& projection = cells.input->projection;
    const Point from = projection ? projection->toDegrees(part.from) : part.from;
    const Point to = projection ? projection->toDegrees(part.to) : part.to;
    parts.append(py::make_tuple(std::pair(from.x, from.y), std::pair(to.x, to.y), part.angle, part.neighbor));
  }
  return parts;
}

}  // namespace

void defineReading(py::module_& module) {
  py::class_<Topology, SharedTopology>(module, "Topology", "The vertices and edges that cells share.")
      .def_property_readonly("vertices", shown<double>(&Topology::vertices))
      .def_property_readonly("vertex_of", shown<std::int32_t>(&Topology::vertex_of))
      .def_property_readonly("edge_of", shown<std::int32_t>(&Topology::edge_of))
      .def_property_readonly("edge_vertices", shown<std::int32_t>(&Topology::edge_vertices))
      .def_property_readonly("edge_cells", shown<std::int64_t>(&Topology::edge_cells))
      .def("__repr__",
           [](const Topology& topology) {
             return fmt::format("<vorpipe.Topology: {} vertices, {} edges>", topology.vertices.size(),
                                topology.edge_cells.size());
           })
      .def(pickles<Topology>());
  py::class_<PlaceFinder, std::shared_ptr<PlaceFinder>>(module, "Locator",
                                                        "Finds the points whose cells hold places.")
      .def("find", &find, py::arg("places"));
  module.def("polygons_of", &polygonsOf, py::arg("cells"), py::arg("site"));
  module.def("topology_of", &topologyOfCells, py::arg("cells"), py::arg("threads"));
  module.def("locator_of", &locatorOf, py::arg("cells"), py::arg("threads"));
  module.def("natural_neighbors", &naturalNeighborsOf, py::arg("cells"), py::arg("places"),
             py::arg("threads"));
  module.def("border_of_cell", &borderOfCell, py::arg("cells"), py::arg("site"));
  module.def("bytes_of", &bytesOf, py::arg("cells"), py::arg("extension"), py::arg("only_cells"));
}

}  // namespace vorpipe::python
