#include "core/assemble.h"

#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/corner_batch.h"
#include "core/row_start.h"
#include "core/wide.h"
#include "parallel.h"

namespace vorpipe {
namespace {

constexpr std::size_t grain = 4096;

/// Writes the edges of cells in the order of the set.
class Writing {
 public:
  Writing(const ProposedCells& proposed, const TiedCells& tied, const Records& records)
      : proposed_(proposed),
        sites_(proposed.sites),
        cells_(proposed.cells),
        tied_(tied),
        records_(records),
        diagram_(records.diagram),
        batch_(proposed.sites) {}

  /// Writes the neighbors of cells begin to end - 1.
  void neighbors(std::size_t begin, std::size_t end) {
    std::array<std::uint64_t, ahead> out{};
    for (auto some = begin; some < end; some += ahead) {
      const auto count = std::min(ahead, end - some);
      for (std::size_t k = 0; k < count; ++k) {
        out[k] = diagram_.cell_offsets[sites_.id[some + k]];
#if defined(__GNUC__)
        __builtin_prefetch(diagram_.neighbors.data() + out[k], 1);
#endif
      }
      for (std::size_t k = 0; k < count; ++k) writeNeighbors(some + k, out[k]);
    }
  }

  /// Writes the polygons of cells begin to end - 1.
  void polygons(std::size_t begin, std::size_t end) {
    for (auto cell = begin; cell < end; ++cell) {
      if (cells_.status[cell] == CellStatus::empty) continue;
      if (tied_.has(cell)) {
        writeTied(cell);
        continue;
      }
      const auto row = edgesOf(cells_, cell);
      auto added = batch_.add(static_cast<std::uint32_t>(cell), row);
      if (added == CornerBatch::Added::full) {
        writeBatch();
        added = batch_.add(static_cast<std::uint32_t>(cell), row);
      }
      if (added == CornerBatch::Added::other) writeAlone(cell, row);
    }
    writeBatch();
  }

 private:
  static constexpr std::size_t ahead = 32;

  void writeNeighbors(std::size_t cell, std::uint64_t out) {
    const auto row = edgesOf(cells_, cell);
    if (tied_.has(cell)) {
      keptEdges(proposed_, tied_, tied_.entry[cell], edges_);
      for (const auto e : edges_) diagram_.neighbors[out++] = outsideIndex(sites_, row[e]);
      return;
    }
    for (const auto neighbor : row) diagram_.neighbors[out++] = outsideIndex(sites_, neighbor);
  }

  void writeBatch() {
    batch_.place();
    for (std::size_t k = 0; k < batch_.size(); ++k) {
      const auto row = batch_.row(k);
      places_.clear();
      for (std::size_t e = 0; e < row.size(); ++e) places_.push_back(batch_.placeOf(batch_.slot(k) + e));
      writePolygon(batch_.cell(k), row);
      writeMoments(batch_.cell(k), places_);
    }
    batch_.clear();
  }

  void writeAlone(std::size_t cell, std::span<const std::int32_t> row) {
    placeCorners(sites_, cell, row, places_);
    writePolygon(cell, row);
    writeMoments(cell, places_);
  }

  void writeTied(std::size_t cell) {
    const auto k = tied_.entry[cell];
    const auto row = edgesOf(cells_, cell);
    keptEdges(proposed_, tied_, k, edges_);
    places_.clear();
    kept_.clear();
    for (const auto e : edges_) {
      places_.push_back(tiedPlace(tied_, k, e));
      kept_.push_back(row[e]);
    }
    writePolygon(cell, kept_);
    placeCorners(sites_, cell, row, places_);
    writeMoments(cell, places_);
  }

  /// Writes the cell with these neighbors whose edges begin in places_.
  void writePolygon(std::size_t cell, std::span<const std::int32_t> row) {
    const auto id = sites_.id[cell];
    auto out = diagram_.cell_offsets[id];
    double perimeter = 0;
    for (std::size_t e = 0; e < row.size(); ++e, ++out) {
      const auto& begin = places_[e];
      const double length = lengthOf(wayBetween(begin, places_[e + 1 < row.size() ? e + 1 : 0]));
      perimeter += length;
      diagram_.vertices[out] = records_.unscale(positionOf(begin));
      diagram_.neighbors[out] = outsideIndex(sites_, row[e]);
      diagram_.edge_lengths[out] = records_.unscale(length);
    }
    diagram_.perimeter[id] = records_.unscale(perimeter);
  }

  /// Writes the second moments of the cell with these corners, before ties join them.
  void writeMoments(std::size_t cell, std::span<const Place> corners) {
    const auto id = sites_.id[cell];
    const auto m = measureCell(measuringOrigin(sites_, cell, corners.front()), corners);
    for (std::size_t k = 0; k < 3; ++k) {
      diagram_.second_moments[id][k] = records_.unscale(m.second_moments[k], 4);
    }
  }

  const ProposedCells& proposed_;
  const SiteSet& sites_;
  const Neighborhoods& cells_;
  const TiedCells& tied_;
  const Records& records_;
  Diagram& diagram_;
  CornerBatch batch_;
  std::vector<std::uint32_t> edges_;
  std::vector<std::int32_t> kept_;
  std::vector<Place> places_;
};

}  // namespace

void makeArrays(const Prepared& prepared, const Sites& sites, const Neighborhoods& cells, Detail detail,
                int threads, Diagram& diagram) {
  const auto count = sites.size();
  // Cells that are found again may come back with a few edges more.
  const auto edges = cells.neighbor.size() + cells.neighbor.size() / 1024 + 64;
  // To touch memory for the first time takes long, so that it is shared out.
  std::vector<std::function<void()>> tasks{
      [&] { diagram.neighbors.resize(edges); },
      [&] { diagram.centroid.resize(count); },
      [&] { diagram.area.resize(count); },
      [&] { diagram.cell_offsets.resize(count + 1); },
      [&] { diagram.status.resize(count, Status::duplicate); },
  };
  if (detail != Detail::measures) {
    tasks.insert(tasks.begin(),
                 {[&] { diagram.vertices.resize(edges); }, [&] { diagram.edge_lengths.resize(edges); },
                  [&] { diagram.second_moments.resize(count); }, [&] { diagram.perimeter.resize(count); }});
  }
  parallelFor(tasks.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (auto task = begin; task < end; ++task) tasks[task]();
  });
  if (prepared.set.size() == count) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (prepared.owner[i] != i) diagram.centroid[i] = {sites.x[i], sites.y[i]};
  }
}

void closeArrays(Diagram& diagram) {
  auto& offsets = diagram.cell_offsets;
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  for (const auto status : diagram.status) {
    diagram.report.ok += status == Status::ok ? 1 : 0;
    diagram.report.empty += status == Status::empty ? 1 : 0;
  }
  diagram.report.duplicate = diagram.status.size() - diagram.report.ok - diagram.report.empty;
  diagram.neighbors.resize(offsets.back());
  if (diagram.vertices.empty()) return;
  diagram.vertices.resize(offsets.back());
  diagram.edge_lengths.resize(offsets.back());
}

void writeEdges(const ProposedCells& proposed, const TiedCells& tied, Detail detail, const Records& records) {
  parallelFor(proposed.sites.size(), grain, proposed.threads, [&](std::size_t begin, std::size_t end) {
    Writing writing(proposed, tied, records);
    if (detail == Detail::measures) {
      writing.neighbors(begin, end);
    } else {
      writing.polygons(begin, end);
    }
  });
}

double areaGap(const Diagram& diagram, const Box& domain, int threads) {
  std::vector<Wide> parts((diagram.area.size() + grain - 1) / grain);
  parallelFor(diagram.area.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    Wide sum{0, 0};
    for (auto i = begin; i < end; ++i) sum = sum + Wide{diagram.area[i], 0};
    parts[begin / grain] = sum;
  });
  const double domain_area = (domain.xmax - domain.xmin) * (domain.ymax - domain.ymin);
  if (!std::isnormal(domain_area)) return 0;
  Wide gap{-domain_area, 0};
  for (const auto part : parts) gap = gap + part;
  return gap.high / domain_area;
}

}  // namespace vorpipe
