#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
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
  entries.push_back({std::string(name) + ".npy", std::move(array.header), zipBody(array.elements)});
}

/// Positions as pairs, which stand nowhere in memory: tens of millions of sites are not copied.
ZipBody pairsOf(const Sites& sites) {
  constexpr std::size_t row = 2 * sizeof(double);
  return {sites.size() * row, [&sites](std::uint64_t offset, char* to, std::size_t length) {
            // An offset may lie inside of a pair: libzip asks for as many bytes as it likes.
            std::size_t copied = 0;
            for (std::uint64_t site = offset / row; copied < length && site < sites.size(); ++site) {
              const double pair[] = {sites.x[site], sites.y[site]};
              const std::string_view bytes(reinterpret_cast<const char*>(pair), row);
              copied += bytes.copy(to + copied, length - copied, (offset + copied) % row);
            }
            return copied;
          }};
}

}  // namespace

Result<void> writeNpzCells(OutputFile& file, const Sites& sites, const Diagram& diagram) {
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
  // NumPy makes float64 of a sum of uint64 and int64, so that offsets are signed.
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
  return writeZip(file, entries);
}

}  // namespace vorpipe
