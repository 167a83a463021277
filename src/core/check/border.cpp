#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/check/cell_rings.h"
#include "core/check/outline.h"
#include "core/check/places.h"
#include "core/geometry/wall_predicates.h"

namespace vorpipe::core::checks {
namespace {

using Edge = CheckedOutline::Edge;

/// Of a straight side: the number of the outline's edge, or that many and a wall's, from xmin to ymax.
struct Stretch {
  std::size_t side;
  double from, to;
  double rounding;  ///< of the cell that has it
};

double alongEdge(const Edge& edge, Point p) {
  return dot(p - edge.a, edge.b - edge.a) / length(edge.b - edge.a);
}

/// The outline's edge along which a cell's edge runs, with the inside to the left of both.
std::optional<std::size_t> sideOf(const CheckedOutline& outline, Point p, Point q, double slack) {
  std::optional<std::size_t> best;
  double least = slack;
  outline.eachNear({(p.x + q.x) / 2, (p.y + q.y) / 2}, slack, [&](std::uint32_t k) {
    const auto& [a, b] = outline.edges()[k];
    const double away = std::max(distance(p, a, b), distance(q, a, b));
    if (!(away <= least) || !(dot(q - p, b - a) > 0)) return;
    best = k;
    least = away;
  });
  return best;
}

WeightedPoint placeOf(const CheckedCells& run, std::size_t i) {
  const Point p = run.site(i);
  return {{countedCoordinate(p.x), countedCoordinate(p.y)},
          run.weighted ? run.sites.weight[i] * run.scale * run.scale : 0};
}

/// Whether a way that lies in the bisector of two sites, but for rounding, has a part in a side of the
/// outline that lies in it exactly.
bool isInSide(const CheckedCells& run, const CheckedOutline& outline,
              std::pair<std::size_t, std::size_t> sites, Point p, Point q) {
  const double rounding = std::max(run.rounding(sites.first), run.rounding(sites.second));
  const WeightedPoint one = placeOf(run, sites.first), other = placeOf(run, sites.second);
  bool found = false;
  outline.eachMeeting(grown(boxAround(p, q), run.ties(run.shorter_side)), [&](std::uint32_t k) {
    const Edge& edge = outline.edges()[k];
    if (found || nearerOf(one, other, edge.a) != 0 || nearerOf(one, other, edge.b) != 0) return;
    const auto [low, high] = std::minmax({alongEdge(edge, p), alongEdge(edge, q)});
    found = std::min(high, length(edge.b - edge.a)) - std::max(low, 0.0) > 4 * rounding;
  });
  return found;
}

std::string wrongAlong(const CheckedCells& run, const CheckedOutline& outline, std::size_t i) {
  std::string wrong;
  CellRings(run, i).eachEdge([&](std::size_t e, Point p, Point q) {
    const std::int64_t neighbor = run.diagram.neighbors[e];
    const double rounding = run.rounding(i);
    if (neighbor == wall_outline && length(q - p) > 2 * rounding && !sideOf(outline, p, q, rounding))
      wrong = fmt::format("edge {} of site {} does not run along the outline", e - run.begin(i), i);
    // Of two cells the first has their edge looked at.
    const auto j = static_cast<std::size_t>(neighbor);
    if (neighbor < 0 || j < i || !isInSide(run, outline, {i, j}, p, q)) return;
    wrong =
        fmt::format("edge {} of site {} runs along the outline, but belongs to {}", e - run.begin(i), i, j);
  });
  return wrong;
}

/// The four walls as sides from one corner of the domain to the next, with the inside to the left.
struct Walls {
  explicit Walls(const Box& box)
      : edges{Edge{{box.xmin, box.ymax}, {box.xmin, box.ymin}},
              Edge{{box.xmax, box.ymin}, {box.xmax, box.ymax}},
              Edge{{box.xmin, box.ymin}, {box.xmax, box.ymin}},
              Edge{{box.xmax, box.ymax}, {box.xmin, box.ymax}}} {}

  /// How far inside of a wall p lies.
  [[nodiscard]] double inside(std::size_t wall, Point p) const {
    const Point a = edges[wall].a;
    return wall == 0 ? p.x - a.x : wall == 1 ? a.x - p.x : wall == 2 ? p.y - a.y : a.y - p.y;
  }

  std::array<Edge, 4> edges;
};

/// What of an edge of the outline lies in the domain, and not in a wall.
std::optional<Stretch> insideWalls(const Walls& walls, const CheckedOutline& outline, std::size_t side) {
  const auto& [a, b] = outline.edges()[side];
  double low = 0, high = 1;
  for (std::size_t wall = 0; wall < walls.edges.size(); ++wall) {
    const double at_a = walls.inside(wall, a), at_b = walls.inside(wall, b);
    if (at_a <= 0 && at_b <= 0) return {};
    if (at_a < 0) low = std::max(low, at_a / (at_a - at_b));
    if (at_b < 0) high = std::min(high, at_a / (at_a - at_b));
  }
  if (!(low < high)) return {};
  const double all = length(b - a);
  return Stretch{side, low * all, high * all, 0};
}

/// The parts of a wall beside which the domain has an inside: between every other two of the places where the
/// outline comes to the wall.
void addWallParts(const Walls& walls, const CheckedOutline& outline, std::size_t wall,
                  std::vector<Stretch>& parts) {
  std::vector<double> crossed;
  const double all = length(walls.edges[wall].b - walls.edges[wall].a);
  for (const auto& [a, b] : outline.edges()) {
    const double at_a = walls.inside(wall, a), at_b = walls.inside(wall, b);
    if ((at_a > 0) == (at_b > 0)) continue;
    const double part = at_a / (at_a - at_b);
    const double along = alongEdge(walls.edges[wall], {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)});
    crossed.push_back(std::clamp(along, 0.0, all));
  }
  std::ranges::sort(crossed);
  for (std::size_t k = 0; k + 1 < crossed.size(); k += 2)
    parts.push_back({outline.edges().size() + wall, crossed[k], crossed[k + 1], 0});
}

/// The edges of the domain, and those that cells have along them.
class Border {
 public:
  Border(const CheckedCells& run, const CheckedOutline& outline)
      : run_(run), outline_(outline), walls_(run.domain) {
    for (std::size_t k = 0; k < outline.edges().size(); ++k) {
      if (const auto part = insideWalls(walls_, outline, k)) wanted_.push_back(*part);
    }
    for (std::size_t wall = 0; wall < walls_.edges.size(); ++wall)
      addWallParts(walls_, outline, wall, wanted_);
    for (std::size_t i = 0; i < run.size(); ++i) addCell(i);
    std::ranges::sort(had_, {}, &Stretch::side);
  }

  [[nodiscard]] std::size_t sides() const { return outline_.edges().size() + walls_.edges.size(); }

  /// What is wrong with a side: a part that no cell has, or more than one, or that is not the domain's.
  [[nodiscard]] std::string wrong(std::size_t side) const {
    const auto wanted = std::ranges::equal_range(wanted_, side, {}, &Stretch::side);
    const auto had = std::ranges::equal_range(had_, side, {}, &Stretch::side);
    std::vector<std::pair<double, int>> ends;
    double rounding = rounding_;
    for (const Stretch& part : wanted) ends.insert(ends.end(), {{part.from, -1}, {part.to, 1}});
    for (const Stretch& part : had) {
      ends.insert(ends.end(), {{part.from, 1}, {part.to, -1}});
      rounding = std::max(rounding, part.rounding);
    }
    std::ranges::sort(ends);
    int more = 0;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      more += ends[k].second;
      if (more == 0 || !(ends[k + 1].first - ends[k].first > 4 * rounding)) continue;
      return said(side, ends[k].first, ends[k + 1].first, more < 0 ? "no cell has" : "too many cells have");
    }
    return {};
  }

 private:
  void addCell(std::size_t i) {
    const auto first = run_.diagram.neighbors.begin() + static_cast<std::ptrdiff_t>(run_.begin(i));
    const auto last = first + static_cast<std::ptrdiff_t>(run_.edges(i));
    if (std::none_of(first, last, [](std::int64_t neighbor) { return neighbor < 0; })) return;
    const double rounding = run_.rounding(i);
    CellRings(run_, i).eachEdge([&](std::size_t e, Point p, Point q) {
      const std::int64_t neighbor = run_.diagram.neighbors[e];
      if (neighbor >= 0) return;
      const auto side = neighbor == wall_outline
                            ? sideOf(outline_, p, q, rounding)
                            : outline_.edges().size() + static_cast<std::size_t>(-1 - neighbor);
      if (!side) return;
      had_.push_back({*side, alongEdge(edge(*side), p), alongEdge(edge(*side), q), rounding});
    });
  }

  [[nodiscard]] const Edge& edge(std::size_t side) const {
    const std::size_t edges = outline_.edges().size();
    return side < edges ? outline_.edges()[side] : walls_.edges[side - edges];
  }

  [[nodiscard]] std::string said(std::size_t side, double from, double to, std::string_view who) const {
    const auto& [a, b] = edge(side);
    const auto at = [&, a = a, b = b](double along) {
      const double part = along / length(b - a);
      return fmt::format("({}, {})", (a.x + part * (b.x - a.x)) / run_.scale,
                         (a.y + part * (b.y - a.y)) / run_.scale);
    };
    return fmt::format("{} the part from {} to {}", who, at(from), at(to));
  }

  const CheckedCells& run_;
  const CheckedOutline& outline_;
  Walls walls_;
  std::vector<Stretch> wanted_, had_;  ///< by side
  double rounding_ = 16 * epsilon * run_.largest;
};

}  // namespace

void checkBorder(const CheckedCells& run, const CheckedOutline& outline, Broken& broken) {
  broken.expect("edges", run.size(), run.threads, [&](std::size_t i) { return wrongAlong(run, outline, i); });
  const Border border(run, outline);
  broken.expect("outline", border.sides(), run.threads, [&](std::size_t side) { return border.wrong(side); });
}

}  // namespace vorpipe::core::checks
