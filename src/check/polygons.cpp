#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "check/checks.h"

namespace vorpipe::core::checks {
namespace {

/// Relative error of a sum of a cell's own numbers.
constexpr double sum_slack = 1e-9;

/// The possible distance of a cell's vertices from their true positions.
struct Slack {
  double reach = 0;     ///< as in CheckedCells
  double rounding = 0;  ///< of a coordinate
  double ties = 0;      ///< how far they may move a vertex
  [[nodiscard]] double position() const { return ties + rounding; }
};

Slack slackOf(const CheckedCells& run, std::size_t i, double reach) {
  return {reach, run.rounding(i), run.ties(reach)};
}

/// The outward unit normal of edge e of cell i, computed only from its neighbor.
Point normalOf(const CheckedCells& run, std::size_t i, std::size_t e) {
  const std::int64_t neighbor = run.diagram.neighbors[e];
  if (neighbor >= 0) {
    const Point d = run.neighborWay(i, e);
    return {d.x / length(d), d.y / length(d)};
  }
  constexpr std::array<Point, 4> walls = {Point{-1, 0}, Point{1, 0}, Point{0, -1}, Point{0, 1}};
  return walls[static_cast<std::size_t>(-1 - neighbor)];
}

/// How far outside the line of edge e, between cell i and its neighbor, p lies.
double beyondEdge(const CheckedCells& run, std::size_t i, std::size_t e, Point p) {
  const Box& box = run.domain;
  switch (run.diagram.neighbors[e]) {
    case wall_xmin:
      return box.xmin - p.x;
    case wall_xmax:
      return p.x - box.xmax;
    case wall_ymin:
      return box.ymin - p.y;
    case wall_ymax:
      return p.y - box.ymax;
    default:
      break;
  }
  return run.beyond(i, static_cast<std::size_t>(run.diagram.neighbors[e]), p, run.shift(e));
}

std::string wrongEdge(const CheckedCells& run, std::size_t i, std::size_t e, const Slack& slack) {
  const Diagram& d = run.diagram;
  const Point a = run.vertex(e), b = run.vertex(run.next(i, e));
  const double apart = length(b - a), said = d.edge_lengths[e] * run.scale;
  if (!(std::abs(apart - said) <= sum_slack * apart + slack.rounding)) {
    return fmt::format("is {} long, its vertices are {} apart", said / run.scale, apart / run.scale);
  }
  for (const Point p : {a, b}) {
    const double off = beyondEdge(run, i, e, p);
    const std::int64_t neighbor = d.neighbors[e];
    const double far = neighbor < 0 ? 0 : run.rounding(static_cast<std::size_t>(neighbor));
    if (!(std::abs(off) <= slack.position() + far)) {
      return fmt::format("ends {} off its line", std::abs(off) / run.scale);
    }
  }
  const Box& box = run.domain;
  const double outside = std::max(run.repeats_x ? 0 : std::max(box.xmin - a.x, a.x - box.xmax),
                                  run.repeats_y ? 0 : std::max(box.ymin - a.y, a.y - box.ymax));
  if (!(outside <= run.rounding(i))) return "leaves the domain";
  const Point c = run.vertex(run.next(i, run.next(i, e)));
  // Each of the three vertices may have been moved by another tie.
  const double sides = length(b - a) + length(c - b) + length(c - a);
  if (!(cross(b - a, c - b) >= -slack.position() * sides)) return "turns clockwise at its end";
  return {};
}

struct Sums {
  Point gap{0, 0};
  double perimeter = 0, area = 0;
  Point origin{0, 0};  ///< the first vertex: differences from a far site would lose all digits
  Point first{0, 0};   ///< moments about the origin
  std::array<double, 3> second{};
};

/// Sums over the triangles of the origin and each edge. In a closed polygon, edge lengths along the normals
/// that the neighbors give sum to zero.
Sums sumsOf(const CheckedCells& run, std::size_t i) {
  const Diagram& d = run.diagram;
  Sums sums;
  sums.origin = run.vertex(run.begin(i));
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    const double edge = d.edge_lengths[e] * run.scale;
    const Point normal = normalOf(run, i, e);
    sums.gap = {sums.gap.x + edge * normal.x, sums.gap.y + edge * normal.y};
    sums.perimeter += edge;
    const Point a = run.vertex(e) - sums.origin, b = run.vertex(run.next(i, e)) - sums.origin;
    const double area = cross(a, b) / 2;
    sums.area += area;
    sums.first = {sums.first.x + area * (a.x + b.x) / 3, sums.first.y + area * (a.y + b.y) / 3};
    sums.second[0] += area * (a.x * a.x + a.x * b.x + b.x * b.x) / 6;
    sums.second[1] += area * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y) / 12;
    sums.second[2] += area * (a.y * a.y + a.y * b.y + b.y * b.y) / 6;
  }
  return sums;
}

/// Compares centroid and second moments with the vertices; `rounding` is that of the area.
std::string wrongMoments(const CheckedCells& run, std::size_t i, const Sums& sums, const Slack& slack,
                         double rounding) {
  const Diagram& d = run.diagram;
  const Point said = Point{d.centroid[i].x * run.scale, d.centroid[i].y * run.scale} - sums.origin;
  const Point off = {said.x * sums.area - sums.first.x, said.y * sums.area - sums.first.y};
  // A cell may be so small that all of its vertices are rounded to its site.
  const double wide = slack.reach + slack.rounding;
  const double allowed = (sum_slack * sums.area + rounding) * wide + slack.rounding * sums.area;
  if (!(length(off) <= allowed)) {
    return fmt::format("has its centroid at ({}, {}), which is not that of its vertices", d.centroid[i].x,
                       d.centroid[i].y);
  }
  const double area = sums.area;
  const std::array<double, 3> central = {sums.second[0] - area * said.x * said.x,
                                         sums.second[1] - area * said.x * said.y,
                                         sums.second[2] - area * said.y * said.y};
  // In the caller's units they may be out of a double's range.
  const double square = run.scale * run.scale;
  for (std::size_t k = 0; k < central.size(); ++k) {
    const double said_moment = d.second_moments[i][k], wanted = central[k] / square / square;
    if (said_moment == wanted) continue;
    if (!(std::abs(said_moment - wanted) <= 4 * allowed * wide / square / square)) {
      return fmt::format("has second moment {}, its vertices give {}", said_moment, wanted);
    }
  }
  return {};
}

/// The possible gap between the ends of the chain of edges, each on its neighbor's line and as long as
/// written, from ties that turned them. Without weights it is within the tolerance of each vertex.
double turnedByTies(const CheckedCells& run, std::size_t i) {
  double turned = 0;
  for (std::size_t e = run.begin(i); e < run.end(i) && run.weighted; ++e) {
    const Point a = run.vertex(e), b = run.vertex(run.next(i, e));
    turned += std::abs(beyondEdge(run, i, e, b) - beyondEdge(run, i, e, a));
  }
  return turned;
}

/// The possible difference between the area of a cell before ties join vertices, which the record has, and
/// the area that the vertices enclose. Each true edge lies on its line, which its vertices may be off. Around
/// each vertex, a region as wide as ties may belong to any of the cells that meet there.
double movedByTies(const CheckedCells& run, std::size_t i, const Slack& slack) {
  double moved = static_cast<double>(run.edges(i)) * 4 * slack.position() * slack.position();
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    const std::size_t end = run.next(i, e);
    const Point a = run.vertex(e), b = run.vertex(end);
    const double off = std::max(std::abs(beyondEdge(run, i, e, a)), std::abs(beyondEdge(run, i, e, b)));
    moved += off * length(b - a);
  }
  return moved;
}

/// What is wrong with a cell whose edges are all ties. How small that makes it depends on the distance of its
/// neighbors.
std::string wrongUnedged(const CheckedCells& run, std::size_t i) {
  const double area = run.diagram.area[i] * run.scale * run.scale;
  const bool right = run.weighted && area >= 0 && area <= tie_slack && run.diagram.perimeter[i] == 0;
  return right ? ""
               : fmt::format("has no edges, but area {} and perimeter {}", run.diagram.area[i],
                             run.diagram.perimeter[i]);
}

std::string wrongCell(const CheckedCells& run, std::size_t i, const Slack& slack) {
  if (run.edges(i) == 0) return wrongUnedged(run, i);
  const Diagram& d = run.diagram;
  const Sums sums = sumsOf(run, i);
  const auto edges = static_cast<double>(run.edges(i));
  const double open = length(sums.gap) - turnedByTies(run, i);
  if (!(open <= tie_slack * (sums.perimeter + slack.reach) + edges * slack.rounding)) {
    return fmt::format("is open by {} of its perimeter", length(sums.gap) / sums.perimeter);
  }
  const double perimeter = d.perimeter[i] * run.scale, area = d.area[i] * run.scale * run.scale;
  const double moved = movedByTies(run, i, slack);
  if (!(std::abs(sums.perimeter - perimeter) <= sum_slack * sums.perimeter)) {
    return fmt::format("has perimeter {}, its edges add up to {}", d.perimeter[i],
                       sums.perimeter / run.scale);
  }
  const double rounding = (edges * epsilon * slack.reach + slack.rounding) * sums.perimeter + moved;
  if (!(std::abs(sums.area - area) <= sum_slack * sums.area + rounding)) {
    return fmt::format("has area {}, its vertices enclose {}", d.area[i],
                       sums.area / (run.scale * run.scale));
  }
  // Ties may remove every edge of a cell only if the site lies outside the domain or has a weight. Two edges
  // are left of a strip between sites so close that the strip's ends are ties.
  const bool inside = run.inDomain(run.site(i)) && !run.weighted;
  const bool filled = inside && edges >= 3 ? area > 0 : area >= -rounding && (edges >= 2 || !inside);
  if (!filled) return fmt::format("has {} edges and area {}", edges, d.area[i]);
  return wrongMoments(run, i, sums, slack, rounding);
}

/// What is wrong with cell i or one of its edges, or nothing.
std::string wrongPolygon(const CheckedCells& run, std::size_t i, const Slack& slack) {
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    const std::string wrong = wrongEdge(run, i, e, slack);
    if (wrong.empty()) continue;
    return fmt::format("site {}: edge {} to neighbor {} {}", i, e - run.begin(i), run.diagram.neighbors[e],
                       wrong);
  }
  const std::string wrong = wrongCell(run, i, slack);
  return wrong.empty() ? wrong : fmt::format("site {}: the cell {}", i, wrong);
}

}  // namespace

void checkPolygons(const CheckedCells& run, Broken& broken) {
  broken.expectEach("polygons", run, [&](std::size_t i) -> std::string {
    if (!run.ok(i)) return {};
    return run.wrongAtAnyReach(i, [&](double reach) { return wrongPolygon(run, i, slackOf(run, i, reach)); });
  });
}

}  // namespace vorpipe::core::checks
