#include <fmt/format.h>

#include "io/cells/edges_file.h"
#include "io/cells/vtk_xml.h"

namespace vorpipe {
namespace {

/// PolyData with lines, z is 0. Edges share their ends, unless a vertex has several positions: in a periodic
/// domain, or in several turns of degrees from a projection.
Result<void> writeVtpEdges(ByteSink& sink, const EdgesOutput& output) {
  const Topology& topology = output.topology;
  const std::size_t count = topology.edge_entry.size();
  const bool apart = !output.diagram.neighbor_shifts.empty() || output.system.from_plane_around;
  const std::size_t points = apart ? 2 * count : topology.vertices.size();
  const auto ends = [&, apart](std::size_t k) -> std::size_t {
    return apart ? k : topology.edge_vertices[k / 2][k % 2];
  };
  const auto position = [&, apart](std::size_t point) {
    if (!apart) return topology.vertices[point];
    const EdgeLine line = edgeLine(output, point / 2);
    return point % 2 == 0 ? line.begin : line.end;
  };
  const auto sites = [&](std::string_view name, std::size_t side) {
    return vtkNumbers<std::int64_t>(
        name, count, [&topology, side](std::size_t edge) { return topology.edge_cells[edge][side]; });
  };
  return writeVtkXml(
      sink,
      {"PolyData",
       fmt::format("NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                   "NumberOfPolys=\"0\"",
                   points, count),
       {{"Points", {vtkPoints("Points", points, position)}},
        {"Lines",
         {vtkNumbers<std::int64_t>("connectivity", 2 * count, ends),
          vtkNumbers<std::int64_t>("offsets", count, [](std::size_t edge) { return 2 * edge + 2; })}},
        {"CellData",
         {vtkNumbers<std::int64_t>("edge", count, [](std::size_t edge) { return edge; }), sites("site_a", 0),
          sites("site_b", 1), vtkNumbers<double>("length", count, [&](std::size_t edge) {
            return output.diagram.edge_lengths[topology.edge_entry[edge]];
          })}}}});
}

}  // namespace

extern const EdgesFormat vtp_edges;
const EdgesFormat vtp_edges{.extension = ".vtp", .write = writeVtpEdges};

}  // namespace vorpipe
