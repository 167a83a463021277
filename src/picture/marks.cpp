#include <algorithm>
#include <array>
#include <utility>

#include "vorpipe/shapes.h"

namespace vorpipe {
namespace {

Point moved(Point place, Point by) { return {place.x + by.x, place.y + by.y}; }

std::vector<Line> edgeLines(const Diagram& cells, const RenderOptions& options) {
  const PicturePlaces places(options);
  std::vector<Line> lines;
  for (const Cell cell : cells) {
    const CellRings rings = cell.rings();
    if (rings.empty()) continue;
    for (const Point by : shownCopies(boxOf(cell.vertices()), options, places)) {
      for (std::size_t r = 0; r < rings.size(); ++r) {
        const auto ring = rings[r];
        const std::size_t first = rings.begin(r) - cell.begin();
        for (std::size_t k = 0; k < ring.size(); ++k) {
          if (!drawsEdge(cell, first + k)) continue;
          const Point to = ring[(k + 1) % ring.size()];
          lines.push_back({places.pixelOf(moved(ring[k], by)), places.pixelOf(moved(to, by))});
        }
      }
    }
  }
  return lines;
}

std::vector<Line> outlineLines(const RenderOptions& options) {
  const PicturePlaces places(options);
  const Outline& outline = options.outline;
  std::vector<Line> lines;
  for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
    const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
    for (auto k = begin; k < end; ++k) {
      const auto next = k + 1 < end ? k + 1 : begin;
      lines.push_back({places.pixelOf(outline.points[k]), places.pixelOf(outline.points[next])});
    }
  }
  return lines;
}

/// An image of a neighbor: the site, and its shift in periods.
using Neighbor = std::pair<std::int64_t, std::array<std::int32_t, 2>>;

/// Finds the neighbors to which a cell draws lines, each once: an outline may leave several edges to one.
void findNeighbors(const Cell& cell, std::vector<Neighbor>& neighbors) {
  neighbors.clear();
  for (std::size_t k = 0; k < cell.edges(); ++k) {
    if (!drawsEdge(cell, k)) continue;
    const bool images = !cell.shifts().empty();
    neighbors.emplace_back(cell.neighbors()[k], images ? cell.shifts()[k] : Neighbor::second_type{});
  }
  std::ranges::sort(neighbors);
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
}

}  // namespace

Result<std::vector<Line>> dualLines(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                                    int threads) {
  const bool periodic = options.periodic != Periodic::none;
  const auto placed = periodic ? wrapped(sites, options.domain, options.periodic, threads) : Sites{};
  if (!placed) return tl::unexpected(placed.error());
  const Sites& at = periodic ? *placed : sites;
  const double width = options.domain.xmax - options.domain.xmin;
  const double height = options.domain.ymax - options.domain.ymin;
  const PicturePlaces places(options);
  std::vector<Line> lines;
  std::vector<Neighbor> neighbors;
  for (const Cell cell : cells) {
    findNeighbors(cell, neighbors);
    const Point from{at.x[cell.index()], at.y[cell.index()]};
    for (const auto& [site, shift] : neighbors) {
      const auto i = static_cast<std::size_t>(site);
      const Point to{at.x[i] + shift[0] * width, at.y[i] + shift[1] * height};
      for (const Point by : shownCopies(boxOf(std::array{from, to}), options, places)) {
        lines.push_back({places.pixelOf(moved(from, by)), places.pixelOf(moved(to, by))});
      }
    }
  }
  return lines;
}

Result<Marks> marksOf(const Sites& sites, const Diagram& cells, const RenderOptions& options, int threads) {
  Marks marks;
  if (options.edges && options.antialias > 1) {
    marks.edges = edgeLines(cells, options);
    marks.outline = outlineLines(options);
  }
  if (options.dual) {
    auto lines = dualLines(sites, cells, options, threads);
    if (!lines) return tl::unexpected(std::move(lines.error()));
    marks.dual = std::move(*lines);
  }
  if (options.labels) {
    auto labels = siteLabels(sites, cells, options, threads);
    if (!labels) return tl::unexpected(std::move(labels.error()));
    marks.labels = std::move(*labels);
  }
  return marks;
}

}  // namespace vorpipe
