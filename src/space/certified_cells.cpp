#include "space/certified_cells.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "space/polyhedra.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t cells_in_batch = 512;

/// Writes what there is of each cell and face.
class RecordWriter {
 public:
  RecordWriter(const ProvedCells& cells, const Contraction& contraction, Detail3 detail, int threads,
               Diagram3& diagram)
      : cells_(cells), contraction_(contraction), detail_(detail), threads_(threads), out_(diagram) {}

  void write() {
    prepare();
    countFaces();
    const bool moments = detail_ == Detail3::polyhedra, all = moments && cells_.moments.empty();
    std::vector<std::uint8_t> careful(cells_.rows.size(), all ? 1 : 0);
    std::vector<std::uint8_t> unmeasured(cells_.rows.size(), 0);
    for (const auto site : cells_.careful) careful[site] = unmeasured[site] = 1;
    parallelFor(cells_.rows.size(), cells_in_batch, threads_, [&](std::size_t begin, std::size_t end) {
      CarefulMeasures measures(cells_.places);
      FaceOrder order(cells_, contraction_);
      for (std::size_t i = begin; i < end; ++i) {
        const Row row = cells_.rows[i];
        if (row.faces == 0) continue;
        order.take(static_cast<Label>(i), row);
        if (order.faces().empty()) continue;
        if (careful[i] != 0) measures.measure(static_cast<Label>(i), row);
        writeCell(i, order, unmeasured[i] != 0 ? measures.measures() : cells_.measures[i],
                  unmeasured[i] != 0 ? measures.areas() : cells_.face_areas[i]);
        if (moments) writeMoments(i, careful[i] != 0 ? measures.secondMoments() : cells_.moments[i]);
      }
    });
  }

 private:
  /// Everything as it is where a site has no cell.
  void prepare() {
    const std::size_t n = cells_.sites.size();
    out_.status.assign(cells_.status.begin(), cells_.status.end());
    out_.owner.assign(cells_.owner.begin(), cells_.owner.end());
    out_.volume.assign(n, 0);
    out_.surface.assign(n, 0);
    out_.centroid.assign(cells_.sites.begin(), cells_.sites.end());
    if (detail_ == Detail3::polyhedra) out_.second_moments.assign(n, {});
    out_.face_offsets.assign(n + 1, 0);
  }

  void countFaces() {
    parallelFor(cells_.rows.size(), cells_in_batch, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Row row = cells_.rows[i];
        if (row.faces == 0) continue;
        std::uint64_t count = row.faces;
        if (const auto cell = contraction_.cellOf(static_cast<Label>(i)); cell != SharedVertices::nowhere) {
          for (std::size_t f = 0; f < row.faces; ++f)
            count -= std::uint64_t{contraction_.remaining(cell, f) == 0};
        }
        const std::uint32_t site = cells_.input[i];
        out_.face_offsets[site + 1] = count;
        if (count == 0) out_.status[site] = Status::empty;
      }
    });
    auto& offsets = out_.face_offsets;
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i) offsets[i + 1] += offsets[i];
    out_.neighbors.resize(offsets.back());
    out_.face_areas.resize(offsets.back());
  }

  void writeCell(std::size_t i, const FaceOrder& order, const CellMeasures& measures,
                 const std::vector<double>& areas) {
    const std::uint32_t site = cells_.input[i];
    const double unit = cells_.unit, square = unit * unit;
    const Point3 &from = cells_.places.sites[i], &to = measures.centroid;
    out_.volume[site] = measures.volume * unit * square;
    out_.surface[site] = measures.surface * square;
    out_.centroid[site] = {(from.x + to.x) * unit, (from.y + to.y) * unit, (from.z + to.z) * unit};
    std::uint64_t at = out_.face_offsets[site];
    for (const auto& face : order.faces()) {
      out_.neighbors[at] = face.neighbor;
      out_.face_areas[at++] = areas[face.face] * square;
    }
  }

  void writeMoments(std::size_t i, const std::array<double, 6>& moments) {
    const double unit = cells_.unit, fifth = unit * unit * unit * unit * unit;
    auto& out = out_.second_moments[cells_.input[i]];
    for (std::size_t e = 0; e < out.size(); ++e) out[e] = moments[e] * fifth;
  }

  const ProvedCells& cells_;
  const Contraction& contraction_;
  Detail3 detail_;
  int threads_;
  Diagram3& out_;
};

}  // namespace

Result<TieCounts> writeDiagram(const ProvedCells& cells, Detail3 detail, int threads, Diagram3& diagram) {
  const bool polyhedra = detail == Detail3::polyhedra;
  auto contraction = Contraction::of(cells.places, cells.rows, cells.tied, polyhedra, threads);
  if (!contraction) return tl::unexpected(std::move(contraction).error());
  if (!polyhedra) contraction->forgetRings();
  RecordWriter(cells, *contraction, detail, threads, diagram).write();
  diagram.flat = contraction->counts().flat;
  if (polyhedra) Polyhedra(cells, *contraction, threads, diagram).write();
  return contraction->counts();
}

}  // namespace vorpipe::space
