#include "io/cells/measures_npz.h"

#include <string>
#include <vector>

#include "io/base/npy_array.h"
#include "io/base/zip_file.h"

namespace vorpipe {
namespace {

template <class Number, std::uint64_t columns = 1, class Row>
ZipEntry entryOf(const char* name, std::span<const Row> rows) {
  NpyArray array = npyArray<Number, columns>(rows);
  return {std::string(name) + ".npy", std::move(array.header), zipBody(array.elements)};
}

Result<void> writeOfDiagram(ByteSink& sink, const CellsOutput& output) {
  const Diagram& diagram = output.diagram;
  std::vector<std::uint32_t> neighbors(diagram.size());
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    neighbors[i] = static_cast<std::uint32_t>(diagram.cell_offsets[i + 1] - diagram.cell_offsets[i]);
  }
  return writeMeasures(sink, {diagram.area, diagram.centroid, neighbors, diagram.status});
}

}  // namespace

Result<void> writeMeasures(ByteSink& sink, const MeasuresOfCells& measures) {
  const ZipEntry entries[] = {entryOf<double>("areas", measures.area),
                              entryOf<double, 2>("centroids", measures.centroid),
                              entryOf<std::uint32_t>("neighbor_counts", measures.neighbors),
                              entryOf<std::uint8_t>("status", measures.status)};
  return writeZip(sink, entries);
}

const CellsFormat npz_measures{.extension = ".npz", .detail = Detail::measures, .write = writeOfDiagram};

}  // namespace vorpipe
