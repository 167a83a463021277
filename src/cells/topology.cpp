#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/try.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr std::uint32_t vacant = std::numeric_limits<std::uint32_t>::max();

std::size_t hash(const Point& point) {
  // Adding 0 makes -0 and 0, which are equal, one bit pattern.
  const auto x = std::bit_cast<std::uint64_t>(point.x + 0.0);
  const auto y = std::bit_cast<std::uint64_t>(point.y + 0.0);
  std::uint64_t bits = (x ^ std::rotl(y, 32)) * 0x9E3779B97F4A7C15u;
  bits ^= bits >> 32;
  bits *= 0xD6E8FEB86659FD93u;
  return bits ^ bits >> 32;
}

/// Indexes positions by value. Uses open addressing: one allocation, where a standard map makes one for each
/// of tens of millions of points.
class PointTable {
 public:
  PointTable(std::size_t most_points, std::vector<Point>& points)
      : slots_(std::bit_ceil(2 * most_points + 1), vacant), points_(points) {}

  std::uint32_t indexOf(const Point& point) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash(point) & mask;; slot = (slot + 1) & mask) {
      std::uint32_t& index = slots_[slot];
      if (index == vacant) {
        index = static_cast<std::uint32_t>(points_.size());
        points_.push_back(point);
        return index;
      }
      const Point& known = points_[index];
      if (known.x == point.x && known.y == point.y) return index;
    }
  }

 private:
  std::vector<std::uint32_t> slots_;
  std::vector<Point>& points_;
};

constexpr std::uint32_t no_twin = ~std::uint32_t{0};

/// The entry of the vertex at which an edge of a cell ends: the next one of its ring.
std::uint64_t nextEntry(const Diagram& diagram, const Cell& cell, std::uint64_t entry) {
  std::uint64_t begin = cell.begin(), end = cell.end();
  const auto& starts = diagram.ring_starts;
  if (!starts.empty()) {
    const auto after = std::ranges::upper_bound(starts, entry);
    if (after != starts.begin()) begin = std::max(begin, *(after - 1));
    if (after != starts.end()) end = std::min(end, *after);
  }
  return entry + 1 < end ? entry + 1 : begin;
}

constexpr std::size_t topology_grain = 4096;

using Shift = std::array<std::int32_t, 2>;

class TwinFinder {
 public:
  TwinFinder(const Diagram& diagram, std::span<const std::uint32_t> vertex_of,
             std::vector<std::uint32_t>& twins)
      : diagram_(diagram), vertex_of_(vertex_of), twins_(twins) {}

  /// Of a pair, the cell with more edges searches the other's list: its neighbors do not each search a cell
  /// with 100,000 neighbors. So each entry is written for one pair only.
  void find(const Cell& cell) {
    for (auto entry = cell.begin(); entry < cell.end(); ++entry) {
      const std::int64_t neighbor = diagram_.neighbors[entry];
      if (isWall(neighbor) || static_cast<std::uint64_t>(neighbor) >= diagram_.size()) continue;
      const Cell other = diagram_.cell(static_cast<std::size_t>(neighbor));
      if (std::pair(other.edges(), other.index()) > std::pair(cell.edges(), cell.index())) continue;
      if (twins_[entry] != no_twin) continue;  // between two images of the same cell
      for (auto back = other.begin(); back < other.end(); ++back) {
        if (back == entry || !areOne(cell, entry, other, back) || twins_[back] != no_twin) continue;
        twins_[entry] = static_cast<std::uint32_t>(back);
        twins_[back] = static_cast<std::uint32_t>(entry);
        break;
      }
    }
  }

 private:
  [[nodiscard]] bool areOne(const Cell& cell, std::uint64_t entry, const Cell& other,
                            std::uint64_t back) const {
    if (diagram_.neighbors[back] != static_cast<std::int64_t>(cell.index())) return false;
    if (!diagram_.neighbor_shifts.empty()) {
      const Shift there = diagram_.neighbor_shifts[entry], here = diagram_.neighbor_shifts[back];
      return there == Shift{-here[0], -here[1]};
    }
    if (diagram_.ring_starts.empty()) return true;
    return vertex_of_[entry] == vertex_of_[nextEntry(diagram_, other, back)] &&
           vertex_of_[back] == vertex_of_[nextEntry(diagram_, cell, entry)];
  }

  const Diagram& diagram_;
  std::span<const std::uint32_t> vertex_of_;
  std::vector<std::uint32_t>& twins_;
};

/// Returns, by entry, the neighbor's entry for the same edge, or no_twin for an edge at a wall. Two cells
/// share one edge, in a periodic domain one for each shift. Along an outline they may share several; the
/// vertices at their ends (`vertex_of`, by entry) distinguish these. Error (input): two cells do not list the
/// same edges with each other.
Result<std::vector<std::uint32_t>> findTwins(const Diagram& diagram, std::span<const std::uint32_t> vertex_of,
                                             int threads) {
  std::vector<std::uint32_t> twins(diagram.neighbors.size(), no_twin);
  parallelFor(diagram.size(), topology_grain, threads, [&](std::size_t begin, std::size_t end) {
    TwinFinder finder(diagram, vertex_of, twins);
    for (auto i = begin; i < end; ++i) finder.find(diagram.cell(i));
  });
  for (const Cell cell : diagram) {
    for (auto entry = cell.begin(); entry < cell.end(); ++entry) {
      const std::int64_t neighbor = diagram.neighbors[entry];
      if (isWall(neighbor) || twins[entry] != no_twin) continue;
      return tl::unexpected(Error{
          ErrorCode::input,
          fmt::format("sites {} and {} do not have the same edges with each other", cell.index(), neighbor)});
    }
  }
  return twins;
}

/// Merges vertices of a periodic domain that are copies of each other: the ends of each edge in its two
/// cells.
void joinCopies(const Diagram& diagram, const std::vector<std::uint32_t>& twins, Topology& topology) {
  auto& vertex_of = topology.vertex_of;
  DisjointSets copies(topology.vertices.size());
  for (const Cell cell : diagram) {
    for (auto entry = cell.begin(); entry < cell.end(); ++entry) {
      const std::uint32_t twin = twins[entry];
      if (twin == no_twin) continue;
      const Cell other = diagram.cell(static_cast<std::size_t>(diagram.neighbors[entry]));
      copies.join(vertex_of[entry], vertex_of[nextEntry(diagram, other, twin)]);
    }
  }
  // The root is the first of the copies, so it gets its new number before the others need it.
  std::vector<std::uint32_t> renumbered(topology.vertices.size());
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < renumbered.size(); ++v) {
    const std::uint32_t root = copies.root(v);
    if (root == v) topology.vertices[count] = topology.vertices[v];
    renumbered[v] = root == v ? count++ : renumbered[root];
  }
  topology.vertices.resize(count);
  for (auto& vertex : vertex_of) vertex = renumbered[vertex];
}

/// Numbers the edges. `edge_of` comes with the twin of each entry, and leaves with the number of its edge.
void numberEdges(const Diagram& diagram, Topology& topology) {
  auto& edge_of = topology.edge_of;
  std::size_t count = 0;
  for (std::size_t entry = 0; entry < edge_of.size(); ++entry) count += edge_of[entry] < entry ? 0u : 1u;
  topology.edge_entry.reserve(count);
  topology.edge_vertices.reserve(count);
  topology.edge_cells.reserve(count);
  for (const Cell cell : diagram) {
    for (auto entry = cell.begin(); entry < cell.end(); ++entry) {
      if (edge_of[entry] < entry) {
        edge_of[entry] = edge_of[edge_of[entry]];
        continue;
      }
      edge_of[entry] = static_cast<std::uint32_t>(topology.edge_entry.size());
      topology.edge_entry.push_back(entry);
      topology.edge_vertices.push_back(
          {topology.vertex_of[entry], topology.vertex_of[nextEntry(diagram, cell, entry)]});
      topology.edge_cells.push_back({static_cast<std::int64_t>(cell.index()), diagram.neighbors[entry]});
    }
  }
}

}  // namespace

Result<DistinctPoints> distinctPoints(std::span<const Point> points) {
  if (points.size() >= vacant) {
    return tl::unexpected(
        Error{ErrorCode::input, fmt::format("{} points are more than {}", points.size(), vacant - 1)});
  }
  DistinctPoints distinct;
  PointTable table(points.size(), distinct.points);
  distinct.index_of.reserve(points.size());
  for (const Point& point : points) distinct.index_of.push_back(table.indexOf(point));
  return distinct;
}

Result<Topology> topologyOf(const Diagram& diagram, int threads) {
  if (diagram.vertices.size() != diagram.neighbors.size()) {
    return tl::unexpected(
        Error{ErrorCode::input,
              fmt::format("the diagram has {} neighbors and {} vertices: topology takes Detail::polygons",
                          diagram.neighbors.size(), diagram.vertices.size())});
  }
  VORPIPE_VAR(distinct, distinctPoints(diagram.vertices));
  Topology topology;
  topology.vertices = std::move(distinct.points);
  topology.vertex_of = std::move(distinct.index_of);
  VORPIPE_VAR(twins, findTwins(diagram, topology.vertex_of, threads));
  if (!diagram.neighbor_shifts.empty()) joinCopies(diagram, twins, topology);
  topology.edge_of = std::move(twins);
  numberEdges(diagram, topology);
  return topology;
}

}  // namespace vorpipe
