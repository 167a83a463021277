#include "support/exact/exact_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "support/exact/exact_bisector.h"
#include "support/exact/exact_neighbors.h"

namespace vorpipe::test {
namespace {

Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y}; }
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y}; }
Vector operator*(const Number& t, const Vector& a) { return {t * a.x, t * a.y}; }
Vector turnedLeft(const Vector& a) { return {-a.y, a.x}; }

/// With the inside to its left.
struct Segment {
  Vector from, to;
};

Vector at(const Segment& s, const Number& part) { return s.from + part * (s.to - s.from); }

struct InOrder {
  bool operator()(const Vector& a, const Vector& b) const { return a.x != b.x ? a.x < b.x : a.y < b.y; }
};

double lengthOf(const Segment& s) {
  const Vector way = s.to - s.from;
  return std::hypot(CGAL::to_double(way.x), CGAL::to_double(way.y));
}

std::vector<Segment> sidesOf(const Outline& outline) {
  std::vector<Segment> sides;
  std::size_t ring = 0;
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    for (const std::size_t outer = ring; ring < outline.polygon_offsets[p + 1]; ++ring) {
      std::vector<Vector> points;
      for (auto k = outline.ring_offsets[ring]; k < outline.ring_offsets[ring + 1]; ++k)
        points.push_back({Number(outline.points[k].x), Number(outline.points[k].y)});
      Number area = 0;
      for (std::size_t k = 0; k < points.size(); ++k)
        area += cross(points[k], points[(k + 1) % points.size()]);
      if ((area > 0) != (ring == outer)) std::ranges::reverse(points);
      for (std::size_t k = 0; k < points.size(); ++k)
        sides.push_back({points[k], points[(k + 1) % points.size()]});
    }
  }
  return sides;
}

/// Whether p lies inside, and on no side.
bool isInside(const std::vector<Segment>& sides, const Vector& p) {
  bool inside = false;
  for (const auto& [a, b] : sides) {
    if (a.y == b.y && a.y == p.y && (a.x <= p.x) == (p.x <= b.x)) return false;
    if ((a.y > p.y) == (b.y > p.y)) {
      if (p.y == a.y && p.x == a.x) return false;
      continue;
    }
    const Number turn = cross(b - a, p - a);
    if (turn == 0) return false;
    if ((turn > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

/// The line on which the powers of two sites are equal. At t it is middle + t * along, and `way` leads to the
/// other site.
struct Line {
  Vector middle, way, along;
  [[nodiscard]] Number beyond(const Vector& p) const { return dot(p - middle, way); }
  [[nodiscard]] Vector at(const Number& t) const { return middle + t * along; }
};

/// Where a line meets the sides, or begins or ends to run along one.
std::vector<Number> meetings(const std::vector<Segment>& sides, const Line& line) {
  std::vector<Number> all;
  const Number squared = dot(line.along, line.along);
  for (const auto& side : sides) {
    const Number a = line.beyond(side.from), b = line.beyond(side.to);
    const auto add = [&](const Vector& p) { all.push_back(dot(p - line.middle, line.along) / squared); };
    if (a == 0) add(side.from);
    if (b == 0) add(side.to);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) add(at(side, a / (a - b)));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// The pieces of the line between two ends, where it has them, that lie inside.
std::vector<Segment> piecesInside(const std::vector<Segment>& sides, const Line& line,
                                  const std::optional<Number>& low, const std::optional<Number>& high) {
  auto stops = meetings(sides, line);
  for (const auto& end : {low, high}) {
    if (end) stops.push_back(*end);
  }
  std::sort(stops.begin(), stops.end());
  std::vector<Segment> pieces;
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    const Number &from = stops[k], &to = stops[k + 1];
    if (from == to || (low && from < *low) || (high && to > *high)) continue;
    if (isInside(sides, line.at((from + to) / 2))) pieces.push_back({line.at(from), line.at(to)});
  }
  return pieces;
}

/// What of a side belongs to a cell: of one that lies in a bisector all, where the inside beside it does.
std::optional<Segment> sideOfCell(const Segment& side, const std::vector<Line>& lines) {
  Number low = 0, high = 1;
  const Vector inward = turnedLeft(side.to - side.from);
  for (const Line& line : lines) {
    const Number a = line.beyond(side.from), b = line.beyond(side.to);
    if (a == 0 && b == 0) {
      if (dot(inward, line.way) > 0) return {};
    } else if (a >= 0 && b >= 0) {
      return {};
    } else if (a > 0) {
      low = std::max(low, Number(a / (a - b)));
    } else if (b > 0) {
      high = std::min(high, Number(a / (a - b)));
    }
  }
  if (!(low < high)) return {};
  return Segment{at(side, low), at(side, high)};
}

/// How many outer rings bound what lies to the left of the segments. Of several that go on from a point the
/// one farthest to the left does, so that rings that touch are apart.
std::size_t countParts(const std::vector<Segment>& segments) {
  std::map<Vector, std::vector<std::size_t>, InOrder> from;
  for (std::size_t k = 0; k < segments.size(); ++k) from[segments[k].from].push_back(k);
  const auto next = [&](std::size_t k) {
    const Vector way = segments[k].to - segments[k].from;
    const auto& all = from.at(segments[k].to);
    const auto rank = [&](const Vector& v) {
      const Number turn = cross(way, v);
      return turn > 0 ? 2 : turn == 0 ? 1 : 0;
    };
    return *std::max_element(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
      const Vector u = segments[a].to - segments[a].from, v = segments[b].to - segments[b].from;
      return rank(u) != rank(v) ? rank(u) < rank(v) : cross(u, v) > 0;
    });
  };
  std::vector<bool> seen(segments.size());
  std::size_t parts = 0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    Number area = 0;
    for (auto e = k; !seen[e]; e = next(e)) {
      seen[e] = true;
      area += cross(segments[e].from, segments[e].to);
    }
    if (area > 0) ++parts;
  }
  return parts;
}

ClippedCell measured(const std::vector<Segment>& boundary) {
  ClippedCell cell;
  Number twice = 0;
  for (const Segment& s : boundary) {
    twice += cross(s.from, s.to);
    cell.perimeter += lengthOf(s);
  }
  cell.area = CGAL::to_double(twice) / 2;
  cell.parts = countParts(boundary);
  return cell;
}

ClippedCell clippedCell(const Sites& sites, const std::vector<Segment>& sides, std::uint32_t i,
                        const std::vector<Spoke>& spokes) {
  const ExactPlaces places(sites);
  const Vector site{Number(sites.x[i]), Number(sites.y[i])};
  std::vector<Segment> boundary;
  std::vector<Line> lines;
  std::vector<ExactEdge> edges;
  for (const Spoke& spoke : spokes) {
    const auto bisector = places.bisector(i, spoke.to);
    lines.push_back({site + bisector.reach / 2 * bisector.way, bisector.way, turnedLeft(bisector.way)});
    std::optional<Number> low, high;
    if (spoke.right != no_site) low = places.meeting(i, bisector, spoke.right);
    if (spoke.left != no_site) high = places.meeting(i, bisector, spoke.left);
    const auto pieces = piecesInside(sides, lines.back(), low, high);
    if (pieces.empty()) continue;
    double length = 0;
    for (const Segment& piece : pieces) length += lengthOf(piece);
    edges.push_back({spoke.to, length, length / lengthOf({site, site + bisector.way})});
    boundary.insert(boundary.end(), pieces.begin(), pieces.end());
  }
  double along = 0;
  for (const Segment& side : sides) {
    const auto part = sideOfCell(side, lines);
    if (!part) continue;
    along += lengthOf(*part);
    boundary.push_back(*part);
  }
  std::ranges::sort(edges, {}, &ExactEdge::neighbor);
  ClippedCell cell = measured(boundary);
  cell.along = along;
  cell.edges = std::move(edges);
  return cell;
}

/// What a diagram says of cell i, in the same words.
ClippedCell saidOf(const Diagram& diagram, std::size_t i) {
  ClippedCell cell;
  const auto begin = diagram.cell_offsets[i], end = diagram.cell_offsets[i + 1];
  cell.area = diagram.area[i];
  cell.perimeter = diagram.perimeter[i];
  std::map<std::int64_t, double> lengths;
  for (auto e = begin; e < end; ++e) {
    const auto neighbor = diagram.neighbors[e];
    (neighbor < 0 ? cell.along : lengths[neighbor]) += diagram.edge_lengths[e];
  }
  for (const auto& [neighbor, length] : lengths) cell.edges.push_back({neighbor, length, 0});
  const auto& starts = diagram.ring_starts;
  for (auto s = std::ranges::lower_bound(starts, begin); s != starts.end() && *s < end; ++s) {
    const auto ring_end = s + 1 != starts.end() ? std::min(*(s + 1), end) : end;
    double twice = 0;
    const Point o = diagram.vertices[*s];
    for (auto e = *s; e + 1 < ring_end; ++e) {
      const Point a = diagram.vertices[e], b = diagram.vertices[e + 1];
      twice += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    }
    if (twice > 0) ++cell.parts;
  }
  return cell;
}

bool isNear(double a, double b, double scale) { return std::abs(a - b) <= 1e-9 * scale; }

/// Edges of one cell and their lengths.
std::string wrongEdges(const ClippedCell& said, const ClippedCell& exact) {
  std::map<std::int64_t, std::pair<double, double>> lengths;
  for (const auto& edge : said.edges) lengths[edge.neighbor].first = edge.length;
  for (const auto& edge : exact.edges) lengths[edge.neighbor].second = edge.length;
  for (const auto& [neighbor, length] : lengths) {
    if (length.second == 0) return fmt::format("has the neighbor {}, along {}", neighbor, length.first);
    if (!isNear(length.first, length.second, exact.perimeter))
      return fmt::format("has {} in common with {}, not {}", length.second, neighbor, length.first);
  }
  return {};
}

std::string wrongCell(const ClippedCell& said, const ClippedCell& exact) {
  if (!isNear(said.area, exact.area, exact.area))
    return fmt::format("has area {}, not {}", exact.area, said.area);
  if (!isNear(said.perimeter, exact.perimeter, exact.perimeter))
    return fmt::format("has perimeter {}, not {}", exact.perimeter, said.perimeter);
  if (said.parts != exact.parts) return fmt::format("has {} parts, not {}", exact.parts, said.parts);
  if (!isNear(said.along, exact.along, exact.perimeter))
    return fmt::format("has {} of the outline, not {}", exact.along, said.along);
  return wrongEdges(said, exact);
}

}  // namespace

std::vector<ClippedCell> clippedCells(const Sites& sites, const Outline& outline) {
  Number::set_relative_precision_of_to_double(1e-12);
  const auto owner = exactOwners(sites);
  const auto neighbors = exactNeighbors(sites, owner);
  const auto sides = sidesOf(outline);
  std::vector<ClippedCell> cells(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (owner[i] == i && neighbors.hidden[i] == 0) cells[i] = clippedCell(sites, sides, i, neighbors.of[i]);
  }
  return cells;
}

std::vector<std::string> compareClipped(const Diagram& diagram, const std::vector<ClippedCell>& exact) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const bool ok = diagram.status[i] == Status::ok;
    const std::string wrong = ok != (exact[i].area > 0)
                                  ? fmt::format("is {}ok, its area is {}", ok ? "" : "not ", exact[i].area)
                                  : wrongCell(saidOf(diagram, i), exact[i]);
    if (!wrong.empty()) lines.push_back(fmt::format("site {} {}", i, wrong));
  }
  return lines;
}

}  // namespace vorpipe::test
