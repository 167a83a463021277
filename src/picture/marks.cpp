#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/try.h"
#include "vorpipe.h"
#include "vorpipe/globe.h"
#include "vorpipe/shapes.h"

namespace vorpipe {
namespace {

/// The visible copies of something along an axis, as numbers of periods.
struct Copies {
  int first = 0, last = 0;
};

/// Returns the copies of an interval from `low` to `high` that meet the part from `begin` to `end`.
Copies copiesOf(double low, double high, double begin, double end, double period) {
  return {static_cast<int>(std::ceil((begin - high) / period)),
          static_cast<int>(std::floor((end - low) / period))};
}

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

std::vector<Line> outlineLines(const Outline& outline, const RenderOptions& options) {
  const PicturePlaces places(options);
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

/// Straight pieces of lines on a map, in pixels.
std::vector<Line> piecesOf(const MapLines& lines, const RenderOptions& options) {
  const PicturePlaces places(options);
  std::vector<Line> pieces;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto line = lines[i];
    for (std::size_t k = 0; k + 1 < line.size(); ++k)
      pieces.push_back({places.pixelOf(line[k]), places.pixelOf(line[k + 1])});
  }
  return pieces;
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

PicturePlaces::PicturePlaces(const RenderOptions& options)
    : view_(shownBox(options)),
      shown_{std::max(view_.xmin, options.domain.xmin), std::max(view_.ymin, options.domain.ymin),
             std::min(view_.xmax, options.domain.xmax), std::min(view_.ymax, options.domain.ymax)},
      frame_(shownFrame(options)) {
  if (options.globe) shown_ = view_;
}

Point PicturePlaces::pixelOf(Point place) const {
  return {frame_.left + (place.x - view_.xmin) / (view_.xmax - view_.xmin) * frame_.width,
          frame_.top + (view_.ymax - place.y) / (view_.ymax - view_.ymin) * frame_.height};
}

Box PicturePlaces::pixels() const {
  const Point first = pixelOf({shown_.xmin, shown_.ymax}), last = pixelOf({shown_.xmax, shown_.ymin});
  return {first.x, first.y, last.x, last.y};
}

double PicturePlaces::pixelsOf(double area) const {
  return area / (view_.ymax - view_.ymin) * (frame_.width / (view_.xmax - view_.xmin) * frame_.height);
}

std::vector<Point> shownCopies(const Box& box, const RenderOptions& options, const PicturePlaces& places) {
  const Box &domain = options.domain, &shown = places.shown();
  if (options.periodic == Periodic::none) {
    const bool misses =
        box.xmin > shown.xmax || box.xmax < shown.xmin || box.ymin > shown.ymax || box.ymax < shown.ymin;
    if (misses && options.view) return {};
    return {Point{0, 0}};
  }
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  Copies columns, rows;
  if (options.periodic != Periodic::y) columns = copiesOf(box.xmin, box.xmax, shown.xmin, shown.xmax, width);
  if (options.periodic != Periodic::x) rows = copiesOf(box.ymin, box.ymax, shown.ymin, shown.ymax, height);
  std::vector<Point> copies;
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column) {
      copies.push_back({column * width, row * height});
    }
  }
  return copies;
}

bool drawsEdge(const Cell& cell, std::size_t edge) {
  const auto here = static_cast<std::int64_t>(cell.index()), there = cell.neighbors()[edge];
  if (here != there) return here < there;
  // A cell that meets its own image has the edge twice, once from either side.
  return cell.shifts()[edge] > std::array<std::int32_t, 2>{};
}

Result<std::vector<Line>> dualLines(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                                    int threads) {
  if (options.globe) return piecesOf(dualOnMap(sites, cells, options, threads), options);
  const bool periodic = options.periodic != Periodic::none;
  VORPIPE_LET(placed, periodic ? wrapped(sites, options.domain, options.periodic, threads) : Sites{});
  const Sites& at = periodic ? placed : sites;
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
  const bool smooth = options.edges && options.antialias > 1;
  if (smooth || !options.borders.empty()) {
    VORPIPE_LET(plane, options.globe ? optionsOnMap(options) : Result<RenderOptions>(options));
    if (smooth) marks.outline = outlineLines(plane.outline, plane);
    marks.borders = outlineLines(plane.borders, plane);
  }
  if (smooth) {
    marks.edges = options.globe ? piecesOf(edgesOnMap(sites, cells, options, threads), options)
                                : edgeLines(cells, options);
  }
  if (options.globe && options.graticule > 0) {
    marks.graticule = piecesOf(graticuleOnMap(options), options);
  }
  if (options.dual) {
    VORPIPE_VAR(lines, dualLines(sites, cells, options, threads));
    marks.dual = std::move(lines);
  }
  if (options.labels) {
    VORPIPE_VAR(labels, siteLabels(sites, cells, options, threads));
    marks.labels = std::move(labels);
  }
  return marks;
}

}  // namespace vorpipe
