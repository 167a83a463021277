#include "cells/diagram_writer.h"

#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "base/double_double.h"
#include "base/parallel.h"
#include "cells/cell_walk.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t diagram_writer_grain = 4096;

/// Writes the edges of cells in the order of the set.
class EdgeWriter {
 public:
  EdgeWriter(const ProposedCells& proposed, const TiedCells& tied, const Unscale& unscale, Diagram& diagram)
      : proposed_(proposed),
        sites_(proposed.sites),
        cells_(proposed.cells),
        tied_(tied),
        unscale_(unscale),
        diagram_(diagram),
        walk_(proposed.sites, proposed.cells) {}

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

  void polygons(std::size_t begin, std::size_t end) {
    walk_(begin, end, [this](std::uint32_t cell, auto row, auto corners) {
      if (tied_.has(cell)) {
        writeTied(cell, row);
      } else {
        writePolygon(cell, row, corners);
      }
      writeMoments(cell, corners);
    });
  }

 private:
  static constexpr std::size_t ahead = 32;

  void writeNeighbors(std::size_t cell, std::uint64_t out) {
    const auto row = cells_.edges(cell);
    if (tied_.has(cell)) {
      keptEdges(proposed_, tied_, tied_.entry[cell], edges_);
      for (const auto e : edges_) diagram_.neighbors[out++] = outsideIndex(sites_, row[e]);
      return;
    }
    for (const auto neighbor : row) diagram_.neighbors[out++] = outsideIndex(sites_, neighbor);
  }

  void writeTied(std::size_t cell, std::span<const std::int32_t> row) {
    const auto k = tied_.entry[cell];
    keptEdges(proposed_, tied_, k, edges_);
    corners_.clear();
    neighbors_.clear();
    for (const auto e : edges_) {
      corners_.push_back(tiedPosition(tied_, k, e));
      neighbors_.push_back(row[e]);
    }
    writePolygon(cell, neighbors_, corners_);
  }

  /// Writes the cell with these neighbors, whose edges begin in `corners`.
  void writePolygon(std::size_t cell, std::span<const std::int32_t> row,
                    std::span<const AnchoredPoint> corners) {
    const auto id = sites_.id[cell];
    auto out = diagram_.cell_offsets[id];
    double perimeter = 0;
    for (std::size_t e = 0; e < row.size(); ++e, ++out) {
      const auto& begin = corners[e];
      const double length = lengthOf(wayBetween(begin, corners[edgeAfter(row, e)]));
      perimeter += length;
      diagram_.vertices[out] = unscale_(positionOf(begin));
      diagram_.neighbors[out] = outsideIndex(sites_, row[e]);
      diagram_.edge_lengths[out] = unscale_(length);
    }
    diagram_.perimeter[id] = unscale_(perimeter);
  }

  /// Writes the second moments of the cell with these corners, before ties join them.
  void writeMoments(std::size_t cell, std::span<const AnchoredPoint> corners) {
    const auto id = sites_.id[cell];
    const auto m = measureCell(measuringOrigin(sites_, cell, corners.front()), corners);
    for (std::size_t k = 0; k < 3; ++k) {
      diagram_.second_moments[id][k] = unscale_(m.second_moments[k], 4);
    }
  }

  const ProposedCells& proposed_;
  const SiteSet& sites_;
  const NeighborRows& cells_;
  const TiedCells& tied_;
  const Unscale& unscale_;
  Diagram& diagram_;
  CellWalk walk_;
  std::vector<std::uint32_t> edges_;
  std::vector<std::int32_t> neighbors_;
  std::vector<AnchoredPoint> corners_;
};

/// Resizes the arrays that `detail` requests. First touch of memory is slow, so threads share it.
void makeArrays(std::size_t count, std::size_t edges, Detail detail, int threads, Diagram& diagram) {
  std::vector<std::function<void()>> tasks;
  const auto make = [&tasks](auto& array, std::size_t size) {
    tasks.emplace_back([&array, size] { array.resize(size); });
  };
  if (detail != Detail::measures) {
    make(diagram.vertices, edges);
    make(diagram.edge_lengths, edges);
    make(diagram.second_moments, count);
    make(diagram.perimeter, count);
  }
  make(diagram.neighbors, edges);
  make(diagram.centroid, count);
  make(diagram.area, count);
  make(diagram.cell_offsets, count + 1);
  make(diagram.status, count);
  parallelFor(tasks.size(), 1, threadsForSteps(count, threads),
              [&](std::size_t task, std::size_t) { tasks[task](); });
}

template <class AreaOf>
double gapOf(std::size_t count, const AreaOf& area_of, const Box& domain, int threads) {
  std::vector<DoubleDouble> parts((count + diagram_writer_grain - 1) / diagram_writer_grain);
  parallelFor(count, diagram_writer_grain, threadsForSteps(count, threads),
              [&](std::size_t begin, std::size_t end) {
                // A single sum would be a dependency chain.
                std::array<DoubleDouble, 4> sums{};
                for (auto i = begin; i < end; ++i) sums[i % 4] = sums[i % 4] + DoubleDouble{area_of(i), 0};
                parts[begin / diagram_writer_grain] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
              });
  const double domain_area = (domain.xmax - domain.xmin) * (domain.ymax - domain.ymin);
  if (!std::isnormal(domain_area)) return 0;
  DoubleDouble gap{-domain_area, 0};
  for (const auto part : parts) gap = gap + part;
  return gap.high / domain_area;
}

}  // namespace

BigVector<CellRecord> makeRecords(const Prepared& prepared, const Sites& sites) {
  BigVector<CellRecord> records(sites.size());
  if (prepared.set.size() == sites.size()) return records;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (prepared.owner[i] != i) records[i] = {0, {sites.x[i], sites.y[i]}, 0, Status::duplicate};
  }
  return records;
}

void takeRecords(std::span<const CellRecord> records, Detail detail, int threads, Diagram& diagram) {
  struct Sums {
    std::uint64_t edges = 0, ok = 0, empty = 0;
  };
  std::vector<Sums> sums((records.size() + diagram_writer_grain - 1) / diagram_writer_grain);
  const int step_threads = threadsForSteps(records.size(), threads);
  parallelFor(records.size(), diagram_writer_grain, step_threads, [&](std::size_t begin, std::size_t end) {
    Sums sum;
    for (auto i = begin; i < end; ++i) {
      sum.edges += records[i].edges;
      sum.ok += records[i].status == Status::ok ? 1u : 0u;
      sum.empty += records[i].status == Status::empty ? 1u : 0u;
    }
    sums[begin / diagram_writer_grain] = sum;
  });
  auto& report = diagram.report;
  std::uint64_t edges = 0;
  for (auto& sum : sums) {
    edges += std::exchange(sum.edges, edges);
    report.ok += sum.ok;
    report.empty += sum.empty;
  }
  report.duplicate = records.size() - report.ok - report.empty;
  makeArrays(records.size(), edges, detail, threads, diagram);
  diagram.cell_offsets.back() = edges;
  parallelFor(records.size(), diagram_writer_grain, step_threads, [&](std::size_t begin, std::size_t end) {
    auto offset = sums[begin / diagram_writer_grain].edges;
    for (auto i = begin; i < end; ++i) {
      const auto& record = records[i];
      diagram.status[i] = record.status;
      diagram.area[i] = record.area;
      diagram.centroid[i] = record.centroid;
      diagram.cell_offsets[i] = offset;
      offset += record.edges;
    }
  });
}

void writeEdges(const ProposedCells& proposed, const TiedCells& tied, Detail detail, const Unscale& unscale,
                Diagram& diagram) {
  const auto count = proposed.sites.size();
  parallelFor(count, grainFor(count, diagram_writer_grain), proposed.threads,
              [&](std::size_t begin, std::size_t end) {
                EdgeWriter writer(proposed, tied, unscale, diagram);
                if (detail == Detail::measures) {
                  writer.neighbors(begin, end);
                } else {
                  writer.polygons(begin, end);
                }
              });
}

void dropPolygons(Diagram& diagram) {
  // Assigning an empty array would keep the memory.
  const auto release = [](auto& array) { std::remove_reference_t<decltype(array)>().swap(array); };
  release(diagram.perimeter);
  release(diagram.second_moments);
  release(diagram.vertices);
  release(diagram.edge_lengths);
  release(diagram.ring_starts);
}

double areaGap(const Diagram& diagram, const Box& domain, int threads) {
  return gapOf(
      diagram.area.size(), [&](std::size_t i) { return diagram.area[i]; }, domain, threads);
}

double areaGap(std::span<const CellRecord> records, const Box& domain, int threads) {
  return gapOf(
      records.size(), [&](std::size_t i) { return records[i].area; }, domain, threads);
}

}  // namespace vorpipe::core

namespace vorpipe {

/// Neumaier's summation: sums separately what each addition rounds off.
double areaSum(const Diagram& diagram) {
  double sum = 0, lost = 0;
  for (const double area : diagram.area) {
    const double next = sum + area;
    lost += std::abs(sum) >= std::abs(area) ? (sum - next) + area : (area - next) + sum;
    sum = next;
  }
  return sum + lost;
}

}  // namespace vorpipe
