#include "backend/cpu/cells.h"

#include <algorithm>
#include <memory>

#include "backend/cpu/clipper.h"
#include "parallel.h"

namespace vorpipe::cpu {
namespace {

constexpr std::size_t edges_in_double = 16;
constexpr std::size_t edges_in_double_most = std::size_t{1} << 17;
constexpr std::size_t grain = 256;

template <std::size_t Edges>
void clipStatusesWithRoom(const CellBatch<float>& batch, glm::vec2 outset, int threads,
                          std::span<CellStatus> status) {
  parallelFor(batch.entries.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
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

struct Polygon {
  CellStatus status = CellStatus::missing;
  std::vector<double> x, y;
  std::vector<std::int32_t> line;
};

template <std::size_t Edges>
Polygon clipPolygon(const CellBatch<double>& batch, const CellBatch<double>::Entry& entry) {
  using Clip = Clipper<double, Edges>;
  Clip clipper{batch.lines.data()};
  // A cut adds at most one edge to the four of the domain.
  clipper.used_edges = static_cast<int>(std::min<std::size_t>(Edges, (entry.count + 4 + 3) / 4 * 4));
  const auto cell = std::make_unique_for_overwrite<typename Clip::Cell>();
  Polygon polygon;
  polygon.status = clipper.clip(*cell, entry, {0, 0});
  if (polygon.status == CellStatus::open && clipper.hasClosedShape(*cell))
    polygon.status = CellStatus::certified;
  if (polygon.status == CellStatus::empty || polygon.status == CellStatus::overflow) return polygon;
  const auto order = std::make_unique_for_overwrite<typename Clip::Order>();
  clipper.orderEdges(*cell, *order);
  const auto count = static_cast<std::size_t>(order->count);
  polygon.x.resize(count);
  polygon.y.resize(count);
  polygon.line.resize(count);
  for (std::size_t k = 0; k < static_cast<std::size_t>(clipper.edgeEnd()); ++k) {
    if (order->rank[k] < 0) continue;
    const auto rank = static_cast<std::size_t>(order->rank[k]);
    const auto start = clipper.edgeStart(*cell, static_cast<int>(k));
    polygon.x[rank] = start.x;
    polygon.y[rank] = start.y;
    const auto line = cell->line[k];
    polygon.line[rank] = line < 0 ? line : line - static_cast<std::int32_t>(entry.first);
  }
  return polygon;
}

Polygon clipPolygonWithRoomAsNeeded(const CellBatch<double>& batch, const CellBatch<double>::Entry& entry) {
  auto polygon = clipPolygon<edges_in_double>(batch, entry);
  if (polygon.status == CellStatus::overflow) polygon = clipPolygon<edges_in_double_most>(batch, entry);
  return polygon;
}

}  // namespace

void clipStatuses(const CellBatch<float>& batch, float outset_x, float outset_y, Room room, int threads,
                  std::span<CellStatus> status) {
  const glm::vec2 outset{outset_x, outset_y};
  if (room == Room::fast) {
    clipStatusesWithRoom<EDGES_FAST>(batch, outset, threads, status);
  } else {
    clipStatusesWithRoom<EDGES_MOST>(batch, outset, threads, status);
  }
}

void clipPolygons(const CellBatch<double>& batch, int threads, CellPolygons& out) {
  std::vector<Polygon> polygons(batch.entries.size());
  parallelFor(batch.entries.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      polygons[e] = clipPolygonWithRoomAsNeeded(batch, batch.entries[e]);
    }
  });
  out = {};
  out.first.push_back(0);
  for (const auto& polygon : polygons) {
    out.status.push_back(polygon.status);
    out.x.insert(out.x.end(), polygon.x.begin(), polygon.x.end());
    out.y.insert(out.y.end(), polygon.y.begin(), polygon.y.end());
    out.line.insert(out.line.end(), polygon.line.begin(), polygon.line.end());
    out.first.push_back(static_cast<std::uint32_t>(out.x.size()));
  }
}

}  // namespace vorpipe::cpu
