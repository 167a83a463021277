#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/cells_writer.h"
#include "io/npy_array.h"
#include "io/zip_file.h"

namespace vorpipe {
namespace {

template <class Number, std::uint64_t columns = 1, class Row>
void add(std::vector<ZipEntry>& entries, const char* name, const std::vector<Row>& rows) {
  NpyArray array = npyArray<Number, columns>(std::span<const Row>(rows));
  entries.push_back({std::string(name) + ".npy", std::move(array.header), array.elements});
}

}  // namespace

Result<void> writeNpzCells(OutputFile& file, const Sites& sites, const Diagram& diagram) {
  std::vector<Point> positions(sites.size());
  for (std::size_t site = 0; site < sites.size(); ++site) {
    positions[site] = {sites.x[site], sites.y[site]};
  }
  std::vector<ZipEntry> entries;
  add<double, 2>(entries, "sites", positions);
  if (!sites.weight.empty()) {
    add<double>(entries, "weights", sites.weight);
  }
  add<std::uint8_t>(entries, "status", diagram.status);
  add<std::uint32_t>(entries, "owners", diagram.owner);
  add<double>(entries, "areas", diagram.area);
  add<double>(entries, "perimeters", diagram.perimeter);
  add<double, 2>(entries, "centroids", diagram.centroid);
  add<double, 3>(entries, "second_moments", diagram.second_moments);
  // NumPy makes float64 of a sum of uint64 and int64, so that offsets are signed.
  add<std::int64_t>(entries, "cell_offsets", diagram.cell_offsets);
  add<double, 2>(entries, "cell_vertices", diagram.vertices);
  add<std::int64_t>(entries, "neighbor_offsets", diagram.cell_offsets);
  add<std::int64_t>(entries, "neighbors", diagram.neighbors);
  add<double>(entries, "edge_lengths", diagram.edge_lengths);
  add<std::uint32_t, 3>(entries, "triangles", diagram.triangles);
  return writeZip(file, entries);
}

}  // namespace vorpipe
