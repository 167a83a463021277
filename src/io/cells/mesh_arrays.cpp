#include "io/cells/mesh_arrays.h"

namespace vorpipe {

VtkSection meshPoints(const CellsMesh& mesh) {
  return {"Points",
          {vtkPoints("Points", mesh.points.size(), [&mesh](std::size_t i) { return mesh.points[i]; })}};
}

std::vector<VtkArray> meshFaces(const CellsMesh& mesh) {
  return {vtkNumbers<std::int64_t>("connectivity", mesh.corners.size(),
                                   [&mesh](std::size_t k) { return mesh.corners[k]; }),
          vtkNumbers<std::int64_t>("offsets", mesh.size(),
                                   [&mesh](std::size_t face) { return mesh.offsets[face + 1]; })};
}

VtkSection meshData(const CellsMesh& mesh, const Sites& sites, const Diagram& diagram) {
  const auto numbers = [&mesh](std::string_view name, const std::vector<double>& by_site) {
    return vtkNumbers<double>(name, mesh.size(), [&](std::size_t face) { return by_site[mesh.sites[face]]; });
  };
  VtkSection data{"CellData", {}};
  data.arrays.push_back(
      vtkNumbers<std::uint32_t>("site", mesh.size(), [&](std::size_t face) { return mesh.sites[face]; }));
  data.arrays.push_back(numbers("area", diagram.area));
  data.arrays.push_back(numbers("perimeter", diagram.perimeter));
  data.arrays.push_back(vtkNumbers<std::int64_t>(
      "neighbors", mesh.size(), [&](std::size_t face) { return diagram.cell(mesh.sites[face]).edges(); }));
  data.arrays.push_back(vtkNumbers<std::uint8_t>(
      "status", mesh.size(), [&](std::size_t face) { return diagram.status[mesh.sites[face]]; }));
  data.arrays.push_back(vtkPoints("centroid", mesh.size(),
                                  [&](std::size_t face) { return diagram.centroid[mesh.sites[face]]; }));
  if (!sites.weight.empty()) data.arrays.push_back(numbers("weight", sites.weight));
  if (!diagram.mass.empty()) data.arrays.push_back(numbers("mass", diagram.mass));
  return data;
}

}  // namespace vorpipe
