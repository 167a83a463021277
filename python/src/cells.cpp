#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "base/try.h"
#include "choices.h"
#include "errors.h"
#include "io/cells/cells_file.h"
#include "io/cells/cells_mesh.h"
#include "io/cells/edges_file.h"
#include "members.h"
#include "results.h"
#include "saving.h"

namespace vorpipe::python {
namespace {

using SharedCells = std::shared_ptr<CellsResult>;

/// The property of a CellsResult that shows an array of its diagram.
template <class Number, class Row>
auto viewed(std::vector<Row> Diagram::*rows) {
  return [rows](const SharedCells& result) {
    return viewOf<Number>(result->shown().*rows, std::shared_ptr<const CellsResult>(result));
  };
}

/// Vertices, the site of each, and triangles of them.
py::tuple triangleMesh(const CellsResult& result) {
  CellTriangles mesh = valueOf(cellTriangles(result.diagram));
  std::vector<std::array<float, 2>> vertices;
  vertices.reserve(mesh.sites.size());
  for (const Point& vertex : result.shown().vertices) {
    vertices.push_back({static_cast<float>(vertex.x), static_cast<float>(vertex.y)});
  }
  return py::make_tuple(arrayOf<float>(std::move(vertices)), arrayOf<std::uint32_t>(std::move(mesh.sites)),
                        arrayOf<std::uint32_t>(std::move(mesh.triangles)));
}

void saveCells(const CellsResult& result, const std::string& path, bool only_cells) {
  const CellsFormat& format = formatOf(result, path, only_cells);
  saveFile(path, result.input->files,
           [&](ByteSink& sink) { return writeCells(sink, outputOf(result, only_cells), format); });
}

void saveEdges(const CellsResult& result, const std::string& path, int threads) {
  const EdgesFormat& format = *valueOf(edgesFormatOf(path));
  requireDetail(result, format.extension, Detail::polygons);
  saveFile(path, result.input->files, [&](ByteSink& sink) -> Result<void> {
    VORPIPE_LET(topology, topologyOf(result, threads));
    return writeLines(sink, edgesOf(result.sites(), result.shown(), topology, result.system()), format);
  });
}

/// The extensions of formats that can leave out records.
std::string featureExtensions() {
  std::vector<std::string_view> extensions;
  for (const std::string_view extension : cellsExtensions()) {
    if ((*cellsFormatOf("cells" + std::string(extension)))->features) extensions.push_back(extension);
  }
  return fmt::format("{}", fmt::join(extensions, ", "));
}

}  // namespace

void requireDetail(const CellsResult& result, std::string_view name, Detail detail) {
  if (detail <= result.options.detail) return;
  raiseInput("detail", fmt::format("{} takes cells that were computed with detail='{}'; these have '{}'",
                                   name, nameOf(detail), nameOf(result.options.detail)));
}

Result<Topology> topologyOf(const CellsResult& result, int threads) {
  auto topology = vorpipe::topologyOf(result.diagram, threads);
  if (topology && result.in_degrees) toDegrees(*result.input->projection, *topology, threads);
  return topology;
}

CellsResult resultOf(std::shared_ptr<const Input> input, CellsOptions options, Diagram diagram, int threads) {
  CellsResult result{std::move(input), std::move(options), std::move(diagram)};
  if (result.input->projection) {
    CellsInDegrees& shown = result.in_degrees.emplace(
        CellsInDegrees{static_cast<const PlacedSites&>(*result.input), result.diagram});
    backToDegrees(shown.placed, shown.diagram, threads);
  }
  return result;
}

const CellsFormat& formatOf(const CellsResult& result, const std::string& path, bool only_cells) {
  const CellsFormat& format = *valueOf(cellsFormatOf(path));
  requireDetail(result, format.extension, format.detail);
  if (only_cells && !format.features) {
    raiseInput("only_cells", fmt::format("{} has no features to leave out; {} have", format.extension,
                                         featureExtensions()));
  }
  return format;
}

CellsOutput outputOf(const CellsResult& result, bool only_cells) {
  CellsOutput output{result.sites(), result.shown(), {}, result.system(), only_cells};
  if (result.input->attributes) output.attributes = result.input->attributes->columns;
  return output;
}

void defineCells(py::module_& module) {
  py::class_<CellsResult, SharedCells>(module, "Cells", "The arrays of a diagram.")
      .def("__len__", [](const CellsResult& result) { return result.diagram.status.size(); })
      .def_property_readonly(
          "input", [](const CellsResult& result) { return std::const_pointer_cast<Input>(result.input); })
      .def_property_readonly("detail",
                             [](const CellsResult& result) { return nameOf(result.options.detail); })
      .def_property_readonly(
          "report",
          [](const SharedCells& result) { return std::shared_ptr<Report>(result, &result->diagram.report); })
      .def_property_readonly("status", viewed<std::uint8_t>(&Diagram::status))
      // Indices have signs, so that their differences do (decision D132).
      .def_property_readonly("owner", viewed<std::int32_t>(&Diagram::owner))
      .def_property_readonly("areas", viewed<double>(&Diagram::area))
      .def_property_readonly("solid_angles", viewed<double>(&Diagram::solid_angle))
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
      .def_property_readonly("vertices_in_plane",
                             [](const SharedCells& result) {
                               return viewOf<double>(result->diagram.vertices,
                                                     std::shared_ptr<const CellsResult>(result));
                             })
      .def_property_readonly("mass", viewed<double>(&Diagram::mass))
      .def_property_readonly("mass_centroids", viewed<double>(&Diagram::mass_centroid))
      .def_property_readonly("triangles", viewed<std::int32_t>(&Diagram::triangles))
      .def("triangle_mesh", &triangleMesh)
      .def("area_sum", [](const CellsResult& result) { return areaSum(result.diagram); })
      .def("save", &saveCells, py::arg("path"), py::arg("only_cells"))
      .def("save_edges", &saveEdges, py::arg("path"), py::arg("threads"))
      .def(pickles<CellsResult>());
  module.def("cells_extensions", &cellsExtensions);
  module.def(
      "carries_attributes", [](const std::string& path) { return valueOf(cellsFormatOf(path))->attributes; },
      py::arg("path"));
}

}  // namespace vorpipe::python
