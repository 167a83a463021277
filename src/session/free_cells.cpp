#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "base/try.h"
#include "geometry/disc_cut.h"
#include "session/session_state.h"
#include "vorpipe.h"
#include "vorpipe/free_surface.h"

namespace vorpipe {

using namespace core;

namespace {

constexpr std::size_t free_cells_grain = 4096;
constexpr int least_points = 3;

/// The polygons of some cells, one after the other.
struct Polygons {
  std::vector<Point> vertices;
  std::vector<std::int64_t> neighbors;
  std::vector<double> lengths;

  void add(Point vertex, std::int64_t neighbor, double length) {
    vertices.push_back(vertex);
    neighbors.push_back(neighbor);
    lengths.push_back(length);
  }
};

/// Cuts the polygons of a diagram, for one thread.
class PolygonCutter {
 public:
  PolygonCutter(const Sites& sites, const Box& domain, int points_of_turn, Diagram& diagram)
      : sites_(sites), domain_(domain), points_of_turn_(points_of_turn), diagram_(diagram) {}

  /// Adds the polygon of a cell that is not empty to `out`.
  void cut(std::size_t i, Polygons& out) {
    const Cell cell(diagram_, i);
    if (cell.edges() == 0) return;
    site_ = {sites_.x[i], sites_.y[i]};
    const double squared_radius = sites_.weight[i];
    origin_ = site_;
    takeCorners(cell);
    if (!DiscCut::isFar(corners_, squared_radius)) {
      lines_.clear();
      for (const auto neighbor : cell.neighbors()) lines_.push_back(lineOf(i, neighbor));
      add(cell, cut_.cut(corners_, lines_, squared_radius), std::sqrt(squared_radius), out);
      return;
    }
    origin_ = cell.vertices()[0];
    takeCorners(cell);
    const Point center{site_.x - origin_.x, site_.y - origin_.y};
    add(cell, cut_.cutFar(corners_, center, squared_radius), std::sqrt(squared_radius), out);
  }

 private:
  void takeCorners(const Cell& cell) {
    corners_.clear();
    for (const Point p : cell.vertices()) corners_.push_back({p.x - origin_.x, p.y - origin_.y});
  }

  [[nodiscard]] EdgeLine lineOf(std::size_t i, std::int64_t neighbor) const {
    if (isWall(neighbor)) {
      switch (static_cast<Wall>(neighbor)) {
        case Wall::xmin:
          return {{-1, 0}, site_.x - domain_.xmin};
        case Wall::xmax:
          return {{1, 0}, domain_.xmax - site_.x};
        case Wall::ymin:
          return {{0, -1}, site_.y - domain_.ymin};
        default:
          return {{0, 1}, domain_.ymax - site_.y};
      }
    }
    const auto j = static_cast<std::size_t>(neighbor);
    const double dx = sites_.x[j] - site_.x, dy = sites_.y[j] - site_.y, distance = std::hypot(dx, dy);
    const double lead = (sites_.weight[i] - sites_.weight[j]) / distance;
    return {{dx / distance, dy / distance}, (distance + lead) / 2};
  }

  [[nodiscard]] Point placed(Point p) const { return {origin_.x + p.x, origin_.y + p.y}; }

  void add(const Cell& cell, DiscShape shape, double radius, Polygons& out) {
    const auto vertices = cell.vertices();
    if (shape == DiscShape::nothing) return;
    if (shape == DiscShape::polygon) {
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        out.add(vertices[k], cell.neighbors()[k], cell.edgeLengths()[k]);
      }
      return;
    }
    double perimeter = radius * cut_.arcAngle();
    auto arc = cut_.arcs().begin();
    const auto chords = cut_.chords();
    for (std::size_t k = 0; k < chords.size(); ++k) {
      if (!chords[k].is_there) continue;
      perimeter += chords[k].length;
      if (chords[k].length > 0) out.add(placed(chords[k].from), cell.neighbors()[k], chords[k].length);
      if (chords[k].leaves) addArc(*arc++, radius, out);
    }
    if (arc != cut_.arcs().end()) addArc(*arc, radius, out);  // a whole circle
    diagram_.perimeter[cell.index()] = perimeter;
    diagram_.second_moments[cell.index()] = cut_.secondMoments();
  }

  /// Adds the lines of an arc.
  void addArc(const Arc& arc, double radius, Polygons& out) {
    const auto pieces =
        std::max(1, static_cast<int>(std::ceil(arc.angle * points_of_turn_ / (2 * std::numbers::pi))));
    const Point from = placed(arc.from);
    const double begin = std::atan2(from.y - site_.y, from.x - site_.x), step = arc.angle / pieces;
    for (int k = 0; k < pieces; ++k) {
      const double angle = begin + k * step;
      const Point p{site_.x + radius * std::cos(angle), site_.y + radius * std::sin(angle)};
      out.add(k == 0 ? from : p, static_cast<std::int64_t>(Wall::outline), radius * step);
    }
  }

  const Sites& sites_;
  const Box& domain_;
  int points_of_turn_;
  Diagram& diagram_;
  Point site_{0, 0}, origin_{0, 0};
  DiscCut cut_;
  std::vector<Point> corners_;
  std::vector<EdgeLine> lines_;
};

/// Clips the polygons of a diagram to discs.
void cutPolygons(const Sites& sites, const Box& domain, int points_of_turn, int threads, Diagram& diagram) {
  const std::size_t count = diagram.size();
  std::vector<Polygons> blocks((count + free_cells_grain - 1) / free_cells_grain);
  std::vector<std::uint64_t> offsets(count + 1);
  parallelFor(count, free_cells_grain, threads, [&](std::size_t begin, std::size_t end) {
    Polygons& block = blocks[begin / free_cells_grain];
    PolygonCutter cutter(sites, domain, points_of_turn, diagram);
    for (auto i = begin; i < end; ++i) {
      const std::size_t before = block.vertices.size();
      if (diagram.status[i] == Status::ok) {
        cutter.cut(i, block);
      } else {
        diagram.perimeter[i] = 0;
        diagram.second_moments[i] = {};
      }
      offsets[i + 1] = block.vertices.size() - before;
    }
  });
  for (std::size_t i = 0; i < count; ++i) offsets[i + 1] += offsets[i];
  Polygons all;
  for (const Polygons& block : blocks) {
    all.vertices.insert(all.vertices.end(), block.vertices.begin(), block.vertices.end());
    all.neighbors.insert(all.neighbors.end(), block.neighbors.begin(), block.neighbors.end());
    all.lengths.insert(all.lengths.end(), block.lengths.begin(), block.lengths.end());
  }
  diagram.cell_offsets = std::move(offsets);
  diagram.vertices = std::move(all.vertices);
  diagram.neighbors = std::move(all.neighbors);
  diagram.edge_lengths = std::move(all.lengths);
}

}  // namespace

Result<Diagram> freeCells(Session& session, const Sites& sites, const CellsOptions& options,
                          int points_of_turn) {
  try {
    if (options.globe) {
      return tl::unexpected(Error{ErrorCode::input, "surface: cells on the globe have no air around them"});
    }
    MovingCells moving(session, options, Surface::free);
    VORPIPE_TRY(moving.update(sites));
    CellsOptions wanted = options;
    wanted.detail = Detail::polygons;
    auto cells = session.cells(sites, wanted);
    if (!cells) return cells;
    // If corners are ties, polygons merge them into one place; the numbers are still those of the earlier
    // cells.
    const CellMoments& moments = moving.moments();
    cells->status = moments.status;
    cells->area = moments.area;
    cells->centroid = moments.centroid;
    cells->report.ok = moving.report().ok;
    cells->report.empty = moving.report().empty;
    cutPolygons(sites, options.domain, std::max(points_of_turn, least_points), 0, *cells);
    return cells;
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

}  // namespace vorpipe
