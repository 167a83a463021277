#include "io/fluid/fluid_series.h"

#include <fmt/format.h>

#include "io/cells/cells_mesh.h"
#include "io/cells/mesh_arrays.h"
#include "io/cells/vtk_xml.h"
#include "io/fluid/wetted_cells.h"

namespace vorpipe {
namespace {

VtkSection dataOf(const CellsMesh& mesh, const FluidState& state) {
  VtkSection data{"CellData", {}};
  const auto add = [&](std::string_view name, const std::vector<double>& by_site) {
    if (by_site.empty()) return;
    data.arrays.push_back(
        vtkNumbers<double>(name, mesh.size(), [&](std::size_t face) { return by_site[mesh.sites[face]]; }));
  };
  data.arrays.push_back(
      vtkNumbers<std::uint32_t>("site", mesh.size(), [&](std::size_t face) { return mesh.sites[face]; }));
  data.arrays.push_back(
      vtkPoints("velocity", mesh.size(), [&](std::size_t face) { return state.velocity[mesh.sites[face]]; }));
  add("pressure", state.pressure);
  add("volume", state.volume);
  add("density", state.density);
  return data;
}

}  // namespace

Result<void> writeFluidStep(ByteSink& sink, const FluidState& state, const FluidOptions& options,
                            const Diagram& diagram) {
  const auto made = options.surface == Surface::free ? Result<CellsMesh>(wettedCells(state.sites, diagram))
                                                     : cellsMesh(sink, diagram);
  return made.and_then([&](const CellsMesh& mesh) {
    return writeVtkXml(
        sink,
        {"PolyData",
         fmt::format("NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                     "NumberOfPolys=\"{}\"",
                     mesh.points.size(), mesh.size()),
         {meshPoints(mesh), {"Polys", meshFaces(mesh)}, dataOf(mesh, state)}});
  });
}

Result<void> writeSeries(ByteSink& sink, const std::vector<SeriesStep>& steps) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const SeriesStep& step : steps) {
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", step.time, step.file);
  }
  return sink.write(text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace vorpipe
