#include "io/cells/fluid_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/number.h"
#include "io/cells/cells_mesh.h"
#include "io/cells/mesh_arrays.h"
#include "io/cells/vtk_xml.h"
#include "io/cells/wetted_cells.h"

namespace vorpipe {
namespace {

constexpr std::string_view series_head =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
constexpr std::string_view before_time = "    <DataSet timestep=\"", before_file = "\" part=\"0\" file=\"";
constexpr std::string_view after_file = "\"/>\n", series_tail = "  </Collection>\n</VTKFile>\n";

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
  std::string text(series_head);
  for (const SeriesStep& step : steps) {
    text += fmt::format("{}{}{}{}{}", before_time, step.time, before_file, step.file, after_file);
  }
  return sink.write(text + std::string(series_tail));
}

Result<std::vector<SeriesStep>> readSeries(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  const auto text = readText(*file);
  if (!text) return tl::unexpected(text.error());
  std::string_view left = *text;
  const auto skip = [&](std::string_view expected) {
    const bool is_there = left.starts_with(expected);
    if (is_there) left.remove_prefix(expected.size());
    return is_there;
  };
  const auto until = [&](std::string_view end) {
    const std::string_view field = left.substr(0, left.find(end));
    left.remove_prefix(field.size());
    return std::string(field);
  };
  std::vector<SeriesStep> steps;
  bool is_good = skip(series_head);
  while (is_good && !skip(series_tail)) {
    is_good = skip(before_time);
    const auto time = parseNumber(until(before_file));
    is_good = is_good && time && skip(before_file);
    std::string name = until(after_file);
    is_good = is_good && skip(after_file);
    if (is_good) steps.push_back({*time, std::move(name)});
  }
  if (is_good && left.empty()) return steps;
  const auto lines = std::count(text->begin(), text->end() - static_cast<std::ptrdiff_t>(left.size()), '\n');
  return inputError(fmt::format("{}:{}: is not as a series of `vorpipe fluid` has it", path, lines + 1));
}

}  // namespace vorpipe
