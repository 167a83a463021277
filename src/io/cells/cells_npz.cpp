#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/base/npy_array.h"
#include "io/base/zip_file.h"
#include "io/cells/cells_file.h"

namespace vorpipe {
namespace {

template <class Number, std::uint64_t columns = 1, class Row>
void add(std::vector<ZipEntry>& entries, const char* name, const std::vector<Row>& rows) {
  NpyArray array = npyArray<Number, columns>(std::span<const Row>(rows));
  entries.push_back({std::string(name) + ".npy", std::move(array.header), zipBody(array.elements)});
}

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

/// Arrays of N sites, M vertices and T triangles: sites (N, 2), weights (N) if sites have them, status uint8
/// (N) with 0 ok, 1 empty, 2 duplicate, owners uint32 (N), areas (N), perimeters (N), centroids (N, 2),
/// second_moments (N, 3), cell_offsets int64 (N + 1), cell_vertices (M, 2), neighbor_offsets int64 (N + 1),
/// neighbors int64 (M), edge_lengths (M), triangles uint32 (T, 3); float64 unless stated. If a diagram has
/// them: neighbor_shifts int32 (M, 2); ring_starts int64, one for each ring; mass (N) and mass_centroids (N,
/// 2).
Result<void> writeNpzCells(ByteSink& sink, const CellsOutput& output) {
  const Sites& sites = output.sites;
  const Diagram& diagram = output.diagram;
  std::vector<ZipEntry> entries;
  const std::uint64_t shape[] = {sites.size(), 2};
  entries.push_back({"sites.npy", npyHeader(npyType<double>(), shape), pairsOf(sites)});
  if (!sites.weight.empty()) {
    add<double>(entries, "weights", sites.weight);
  }
  add<std::uint8_t>(entries, "status", diagram.status);
  add<std::uint32_t>(entries, "owners", diagram.owner);
  add<double>(entries, "areas", diagram.area);
  add<double>(entries, "perimeters", diagram.perimeter);
  add<double, 2>(entries, "centroids", diagram.centroid);
  add<double, 3>(entries, "second_moments", diagram.second_moments);
  // Offsets are signed because NumPy's sum of uint64 and int64 is float64.
  add<std::int64_t>(entries, "cell_offsets", diagram.cell_offsets);
  add<double, 2>(entries, "cell_vertices", diagram.vertices);
  add<std::int64_t>(entries, "neighbor_offsets", diagram.cell_offsets);
  add<std::int64_t>(entries, "neighbors", diagram.neighbors);
  if (!diagram.neighbor_shifts.empty()) {
    add<std::int32_t, 2>(entries, "neighbor_shifts", diagram.neighbor_shifts);
  }
  if (!diagram.ring_starts.empty()) {
    add<std::int64_t>(entries, "ring_starts", diagram.ring_starts);
  }
  if (!diagram.mass.empty()) {
    add<double>(entries, "mass", diagram.mass);
    add<double, 2>(entries, "mass_centroids", diagram.mass_centroid);
  }
  add<double>(entries, "edge_lengths", diagram.edge_lengths);
  add<std::uint32_t, 3>(entries, "triangles", diagram.triangles);
  return writeZip(sink, entries);
}

}  // namespace

extern const CellsFormat npz_cells;
const CellsFormat npz_cells{.extension = ".npz", .detail = Detail::everything, .write = writeNpzCells};

}  // namespace vorpipe
