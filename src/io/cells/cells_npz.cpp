#include <cstdint>
#include <string_view>
#include <vector>

#include "io/cells/cells_writers.h"
#include "io/cells/npz_arrays.h"

namespace vorpipe {
namespace {

/// Positions as pairs, made on demand: tens of millions of sites are not copied.
ZipBody pairsOf(const Sites& sites) {
  constexpr std::size_t row = 2 * sizeof(double);
  return {sites.size() * row, [&sites](std::uint64_t offset, char* to, std::size_t length) {
            // An offset may lie inside a pair: readers request any number of bytes.
            std::size_t copied = 0;
            for (std::uint64_t site = offset / row; copied < length && site < sites.size(); ++site) {
              const double pair[] = {sites.x[site], sites.y[site]};
              const std::string_view bytes(reinterpret_cast<const char*>(pair), row);
              copied += bytes.copy(to + copied, length - copied, (offset + copied) % row);
            }
            return copied;
          }};
}

Result<void> writeMeasuresOf(ByteSink& sink, const CellsOutput& output) {
  const Diagram& diagram = output.diagram;
  std::vector<std::uint32_t> neighbors(diagram.size());
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    neighbors[i] = static_cast<std::uint32_t>(diagram.cell_offsets[i + 1] - diagram.cell_offsets[i]);
  }
  return writeMeasures(sink, {diagram.area, diagram.centroid, neighbors, diagram.status});
}

}  // namespace

Result<void> writeNpzCells(ByteSink& sink, const CellsOutput& output) {
  const Sites& sites = output.sites;
  const Diagram& diagram = output.diagram;
  NpzArrays arrays;
  const std::uint64_t shape[] = {sites.size(), 2};
  arrays.add("sites", npyHeader(npyType<double>(), shape), pairsOf(sites));
  arrays.addUnlessEmpty<double>("weights", sites.weight);
  arrays.add<std::uint8_t>("status", diagram.status);
  arrays.add<std::uint32_t>("owners", diagram.owner);
  arrays.add<double>("areas", diagram.area);
  arrays.add<double>("perimeters", diagram.perimeter);
  arrays.add<double, 2>("centroids", diagram.centroid);
  if (diagram.solid_angle.empty()) {
    arrays.add<double, 3>("second_moments", diagram.second_moments);
  } else {
    arrays.add<double>("solid_angles", diagram.solid_angle);
  }
  // Offsets are signed because NumPy's sum of uint64 and int64 is float64.
  arrays.add<std::int64_t>("cell_offsets", diagram.cell_offsets);
  arrays.add<double, 2>("cell_vertices", diagram.vertices);
  arrays.add<std::int64_t>("neighbor_offsets", diagram.cell_offsets);
  arrays.add<std::int64_t>("neighbors", diagram.neighbors);
  arrays.addUnlessEmpty<std::int32_t, 2>("neighbor_shifts", diagram.neighbor_shifts);
  arrays.addUnlessEmpty<std::int64_t>("ring_starts", diagram.ring_starts);
  if (!diagram.mass.empty()) {
    arrays.add<double>("mass", diagram.mass);
    arrays.add<double, 2>("mass_centroids", diagram.mass_centroid);
  }
  arrays.add<double>("edge_lengths", diagram.edge_lengths);
  arrays.add<std::uint32_t, 3>("triangles", diagram.triangles);
  return arrays.write(sink);
}

Result<void> writeMeasures(ByteSink& sink, const MeasuresOfCells& measures) {
  NpzArrays arrays;
  arrays.add<double>("areas", measures.area);
  arrays.add<double, 2>("centroids", measures.centroid);
  arrays.add<std::uint32_t>("neighbor_counts", measures.neighbors);
  arrays.add<std::uint8_t>("status", measures.status);
  return arrays.write(sink);
}

const CellsFormat npz_measures{.extension = ".npz", .detail = Detail::measures, .write = writeMeasuresOf};

}  // namespace vorpipe
