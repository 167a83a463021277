#include "backend/cpu/batch_cells.h"

#include <algorithm>
#include <memory>

#include "backend/collect.h"
#include "backend/cpu/clipper.h"
#include "base/parallel.h"

namespace vorpipe::cpu {
namespace {

constexpr std::size_t edges_in_double = 16;
constexpr std::size_t edges_in_double_most = std::size_t{1} << 17;
constexpr std::size_t batch_cells_grain = 256;

template <std::size_t Edges>
void clipStatusesWithRoom(const CellBatch<float>& batch, glm::vec2 outset, int threads,
                          std::span<CellStatus> status) {
  parallelFor(batch.entries.size(), batch_cells_grain, threads, [&](std::size_t begin, std::size_t end) {
    Clipper<float, Edges> clipper{batch.lines.data()};
    typename Clipper<float, Edges>::Cell cell;
    for (std::size_t e = begin; e < end; ++e) {
      status[e] = clipper.clip(cell, batch.entries[e], outset);
      if (Edges > EDGES_FAST && status[e] == CellStatus::open && clipper.hasClosedShape(cell)) {
        status[e] = CellStatus::certified;
      }
    }
  });
}

template <std::size_t Edges>
CellStatus clipNeighborhood(const CellBatch<double>& batch, const CellBatch<double>::Entry& entry,
                            std::vector<std::int32_t>& neighbors) {
  using Clip = Clipper<double, Edges>;
  Clip clipper{batch.lines.data()};
  // A cut adds at most one edge to the four of the domain.
  clipper.used_edges =
      static_cast<int>(std::min<std::size_t>(Edges, (std::size_t{entry.count} + 4 + 3) / 4 * 4));
  const auto cell = std::make_unique_for_overwrite<typename Clip::Cell>();
  auto status = clipper.clip(*cell, entry, {0, 0});
  if (status == CellStatus::open && clipper.hasClosedShape(*cell)) status = CellStatus::certified;
  if (status != CellStatus::certified) return status;
  const auto order = std::make_unique_for_overwrite<typename Clip::Order>();
  clipper.orderEdges(*cell, *order);
  const auto first = neighbors.size();
  neighbors.resize(first + static_cast<std::size_t>(order->count));
  for (std::size_t k = 0; k < static_cast<std::size_t>(clipper.edgeEnd()); ++k) {
    if (order->rank[k] < 0) continue;
    const auto line = cell->line[k];
    neighbors[first + static_cast<std::size_t>(order->rank[k])] =
        line < 0 ? line : line - static_cast<std::int32_t>(entry.first);
  }
  return status;
}

}  // namespace

void clipStatuses(const CellBatch<float>& batch, float outset_x, float outset_y, Capacity capacity,
                  int threads, std::span<CellStatus> status) {
  const glm::vec2 outset{outset_x, outset_y};
  if (capacity == Capacity::small) {
    clipStatusesWithRoom<EDGES_FAST>(batch, outset, threads, status);
  } else {
    clipStatusesWithRoom<EDGES_MOST>(batch, outset, threads, status);
  }
}

void clipBatch(const CellBatch<double>& batch, int threads, CellNeighbors& out) {
  collect(batch.entries.size(), threads, out, [&] {
    return [&](std::size_t e, std::vector<std::int32_t>& neighbors) {
      const auto status = clipNeighborhood<edges_in_double>(batch, batch.entries[e], neighbors);
      if (status != CellStatus::overflow) return status;
      return clipNeighborhood<edges_in_double_most>(batch, batch.entries[e], neighbors);
    };
  });
}

}  // namespace vorpipe::cpu
