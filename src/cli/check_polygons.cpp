#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/checked_run.h"

namespace vorpipe::cli {
namespace {

/// A vertex stands for all that ties join, each shorter than 1e-6 of the distance between two sites,
/// which is at most twice the distance from vertex to site.
constexpr double tie_slack = 1e-5;
/// Of a sum of a cell's own numbers.
constexpr double sum_slack = 1e-9;

/// What may separate the vertices of a cell from where they belong.
struct Slack {
  double reach = 0;     ///< largest distance from the site to a vertex
  double rounding = 0;  ///< of a coordinate
  [[nodiscard]] double position() const { return tie_slack * reach + rounding; }
};

Slack slackOf(const CheckedRun& run, std::size_t i) {
  const Box& box = run.domain();
  Slack slack;
  for (std::size_t v = run.begin(i); v < run.end(i); ++v) {
    slack.reach = std::max(slack.reach, length(run.diagram.vertices[v] - run.site(i)));
  }
  const double largest =
      std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax),
                std::abs(run.input.sites.x[i]), std::abs(run.input.sites.y[i])});
  slack.rounding = 16 * epsilon * largest;
  return slack;
}

/// The outward unit normal of an edge of cell i, from its neighbor alone.
Point normalOf(const CheckedRun& run, std::size_t i, std::int64_t neighbor) {
  if (neighbor >= 0) {
    const Point d = run.site(static_cast<std::size_t>(neighbor)) - run.site(i);
    return {d.x / length(d), d.y / length(d)};
  }
  constexpr std::array<Point, 4> walls = {Point{-1, 0}, Point{1, 0}, Point{0, -1}, Point{0, 1}};
  return walls[static_cast<std::size_t>(-1 - neighbor)];
}

/// How far outside the line between cell i and its neighbor p lies.
double beyondEdge(const CheckedRun& run, std::size_t i, std::int64_t neighbor, Point p) {
  const Box& box = run.domain();
  switch (neighbor) {
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
  return beyondBisector(run.site(i), run.site(static_cast<std::size_t>(neighbor)), p);
}

std::string brokenEdge(const CheckedRun& run, std::size_t i, std::size_t e, const Slack& slack) {
  const Diagram& d = run.diagram;
  const Point a = d.vertices[e], b = run.after(i, e);
  const double apart = length(b - a);
  if (!(std::abs(apart - d.edge_lengths[e]) <= sum_slack * apart)) {
    return fmt::format("is {} long, its vertices are {} apart", d.edge_lengths[e], apart);
  }
  for (const Point p : {a, b}) {
    const double off = beyondEdge(run, i, d.neighbors[e], p);
    if (!(std::abs(off) <= slack.position())) return fmt::format("ends {} off its line", std::abs(off));
    for (const std::int64_t wall : {wall_xmin, wall_xmax, wall_ymin, wall_ymax}) {
      if (!(beyondEdge(run, i, wall, p) <= slack.position())) return "leaves the domain";
    }
  }
  const Point c = run.after(i, e + 1 < run.end(i) ? e + 1 : run.begin(i));
  if (!(cross(b - a, c - b) >= -slack.position() * length(c - a))) return "turns clockwise at its end";
  return {};
}

/// Edge lengths along the normals that the neighbors give add up to nothing in a closed polygon, and the
/// vertices enclose, counter-clockwise, the area that is reported.
std::string brokenSums(const CheckedRun& run, std::size_t i, const Slack& slack) {
  const Diagram& d = run.diagram;
  const auto edges = static_cast<double>(run.end(i) - run.begin(i));
  Point gap{0, 0};
  double perimeter = 0, area = 0;
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    const Point normal = normalOf(run, i, d.neighbors[e]);
    gap = {gap.x + d.edge_lengths[e] * normal.x, gap.y + d.edge_lengths[e] * normal.y};
    perimeter += d.edge_lengths[e];
    area += cross(d.vertices[e] - run.site(i), run.after(i, e) - run.site(i)) / 2;
  }
  if (!(length(gap) <= tie_slack * (perimeter + slack.reach) + edges * slack.rounding)) {
    return fmt::format("is open by {} of its perimeter {}", length(gap), perimeter);
  }
  if (!(std::abs(perimeter - d.perimeter[i]) <= sum_slack * perimeter)) {
    return fmt::format("has perimeter {}, its edges add up to {}", d.perimeter[i], perimeter);
  }
  const double rounding = edges * epsilon * slack.reach * perimeter;
  if (!(std::abs(area - d.area[i]) <= sum_slack * area + rounding)) {
    return fmt::format("has area {}, its vertices enclose {}", d.area[i], area);
  }
  // Ties may take everything from a cell only where the site does not lie in the domain: else the cell is
  // as wide as the way to the nearest site.
  const bool filled = run.inDomain(run.site(i)) ? edges >= 3 && d.area[i] > 0 : d.area[i] >= -rounding;
  return filled ? std::string() : fmt::format("has {} edges and area {}", edges, d.area[i]);
}

}  // namespace

std::string brokenPolygon(const CheckedRun& run) {
  for (std::size_t i = 0; i < run.input.sites.size(); ++i) {
    if (!run.ok(i)) continue;
    const Slack slack = slackOf(run, i);
    for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
      const std::string broken = brokenEdge(run, i, e, slack);
      if (broken.empty()) continue;
      return fmt::format("site {}: edge {} to neighbor {} {}", i, e - run.begin(i), run.diagram.neighbors[e],
                         broken);
    }
    const std::string broken = brokenSums(run, i, slack);
    if (!broken.empty()) return fmt::format("site {}: the cell {}", i, broken);
  }
  return {};
}

}  // namespace vorpipe::cli
