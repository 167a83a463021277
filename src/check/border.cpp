#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "check/outline.h"
#include "check/places.h"
#include "geometry/vertex_predicates.h"

namespace vorpipe::core::checks {
namespace {

using Edge = CheckedOutline::Edge;

/// A part of a straight side. `side` is the index of an outline's edge, or the number of these edges plus a
/// wall's number, from xmin to ymax.
struct Stretch {
  std::size_t side;
  double from, to;
  double slack;  ///< how far rounding and ties may have moved the ends `from` and `to`
};

double alongEdge(const Edge& edge, Point p) {
  return dot(p - edge.a, edge.b - edge.a) / length(edge.b - edge.a);
}

Point placeAlong(const Edge& edge, double along) {
  const double part = along / length(edge.b - edge.a);
  return {edge.a.x + part * (edge.b.x - edge.a.x), edge.a.y + part * (edge.b.y - edge.a.y)};
}

/// Calls take(k, from, to) for each edge of the outline that the segment from p to q runs along, both with
/// the inside to the left. `from` and `to` bound the common part. Usually there is one edge, but rounding may
/// have joined several on a line.
template <class Take>
void eachAlong(const CheckedOutline& outline, Point p, Point q, double slack, const Take& take) {
  outline.eachMeeting(grown(boxAround(p, q), slack), [&](std::uint32_t k) {
    const Edge& edge = outline.edges()[k];
    const double all = length(edge.b - edge.a);
    const double from = std::clamp(alongEdge(edge, p), 0.0, all),
                 to = std::clamp(alongEdge(edge, q), 0.0, all);
    if (!(from < to)) return;
    const auto isNear = [&](double along) { return distance(placeAlong(edge, along), p, q) <= slack; };
    if (isNear(from) && isNear(to)) take(k, from, to);
  });
}

WeightedPoint placeOf(const CheckedCells& run, std::size_t i) {
  const Point p = run.site(i);
  return {{countedCoordinate(p.x), countedCoordinate(p.y)},
          run.weighted ? run.sites.weight[i] * run.scale * run.scale : 0};
}

/// Whether a segment on the bisector of two sites, up to rounding, shares a part with a side of the outline
/// that lies exactly on the bisector.
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

}  // namespace

bool isWhereSideIsBisector(const CheckedCells& run, const CheckedOutline& outline, std::size_t i,
                           std::size_t j, Point p) {
  const double rounding = 2 * std::max(run.rounding(i), run.rounding(j));
  const WeightedPoint one = placeOf(run, i), other = placeOf(run, j);
  bool found = false;
  outline.eachNear(p, rounding, [&](std::uint32_t k) {
    const auto& [a, b] = outline.edges()[k];
    if (found || distance(p, a, b) > rounding) return;
    const bool at_a = nearerOf(one, other, a) == 0, at_b = nearerOf(one, other, b) == 0;
    found = (at_a && (at_b || length(p - a) <= rounding)) || (at_b && length(p - b) <= rounding);
  });
  return found;
}

namespace {

std::string wrongAlong(const CheckedCells& run, const CheckedOutline& outline, std::size_t i) {
  std::string wrong;
  CellRings(run, i).eachEdge([&](std::size_t e, Point p, Point q) {
    const std::int64_t neighbor = run.diagram.neighbors[e];
    const double rounding = run.rounding(i);
    // A common edge of two cells that is a tie may count as the outline's.
    const double tie = std::max(4 * rounding, run.ties(run.weighted ? run.shorter_side : run.reach(i)));
    if (neighbor == wall_outline && length(q - p) > tie) {
      double covered = 0;
      eachAlong(outline, p, q, rounding, [&](std::size_t, double from, double to) { covered += to - from; });
      if (length(q - p) - covered > tie)
        wrong = fmt::format("edge {} of site {} does not run along the outline", e - run.begin(i), i);
    }
    // The common edge of two cells is checked only for the first.
    const auto j = static_cast<std::size_t>(neighbor);
    if (neighbor < 0 || j < i || !isInSide(run, outline, {i, j}, p, q)) return;
    wrong =
        fmt::format("edge {} of site {} runs along the outline, but belongs to {}", e - run.begin(i), i, j);
  });
  return wrong;
}

/// The four walls as sides between corners of the domain, with the inside to the left.
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

/// The wall that an edge of the outline lies on, up to rounding, both with the inside to the left.
std::optional<std::size_t> wallOf(const Walls& walls, const Edge& edge, double rounding) {
  for (std::size_t wall = 0; wall < walls.edges.size(); ++wall) {
    const Edge& along = walls.edges[wall];
    if (std::abs(walls.inside(wall, edge.a)) <= rounding &&
        std::abs(walls.inside(wall, edge.b)) <= rounding && dot(edge.b - edge.a, along.b - along.a) > 0)
      return wall;
  }
  return {};
}

/// The part of an edge of the outline that lies in the domain but not on a wall.
std::optional<Stretch> insideWalls(const Walls& walls, const CheckedOutline& outline, std::size_t side,
                                   double rounding) {
  const auto& [a, b] = outline.edges()[side];
  if (wallOf(walls, {a, b}, rounding)) return {};
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

/// The parts of a wall with an inside next to them: every other interval between places where the outline
/// meets the wall.
void addWallParts(const Walls& walls, const CheckedOutline& outline, std::size_t wall, double rounding,
                  std::vector<Stretch>& parts) {
  std::vector<double> crossed;
  const double all = length(walls.edges[wall].b - walls.edges[wall].a);
  for (const auto& [a, b] : outline.edges()) {
    const double at_a = walls.inside(wall, a), at_b = walls.inside(wall, b);
    if ((at_a > rounding) == (at_b > rounding)) continue;
    const double part = std::clamp(at_a / (at_a - at_b), 0.0, 1.0);
    const double along = alongEdge(walls.edges[wall], {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)});
    crossed.push_back(std::clamp(along, 0.0, all));
  }
  std::ranges::sort(crossed);
  for (std::size_t k = 0; k + 1 < crossed.size(); k += 2)
    parts.push_back({outline.edges().size() + wall, crossed[k], crossed[k + 1], 0});
}

/// The edges of the domain, and the cells' edges along them.
class Border {
 public:
  Border(const CheckedCells& run, const CheckedOutline& outline)
      : run_(run), outline_(outline), walls_(run.domain) {
    for (std::size_t k = 0; k < outline.edges().size(); ++k) {
      if (const auto part = insideWalls(walls_, outline, k, rounding_)) wanted_.push_back(*part);
    }
    for (std::size_t wall = 0; wall < walls_.edges.size(); ++wall)
      addWallParts(walls_, outline, wall, rounding_, wanted_);
    for (std::size_t i = 0; i < run.size(); ++i) addCell(i);
    std::ranges::sort(had_, {}, &Stretch::side);
  }

  [[nodiscard]] std::size_t sides() const { return outline_.edges().size() + walls_.edges.size(); }

  /// What is wrong with a side: a part that no cell or more than one has, or a part that is not the domain's.
  [[nodiscard]] std::string wrong(std::size_t side) const {
    const auto ofSide = [side](const std::vector<Stretch>& all) {
      return std::span(std::ranges::lower_bound(all, side, {}, &Stretch::side),
                       std::ranges::upper_bound(all, side, {}, &Stretch::side));
    };
    const auto wanted = ofSide(wanted_), had = ofSide(had_);
    std::vector<std::pair<double, int>> ends;
    // For a side that no cell has, the cells do not determine how much may be missing.
    double slack = had.empty() ? run_.ties(run_.shorter_side) : rounding_;
    for (const Stretch& part : wanted) ends.insert(ends.end(), {{part.from, -1}, {part.to, 1}});
    for (const Stretch& part : had) {
      ends.insert(ends.end(), {{part.from, 1}, {part.to, -1}});
      slack = std::max(slack, part.slack);
    }
    std::ranges::sort(ends);
    int more = 0;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      more += ends[k].second;
      const double from = ends[k].first, to = ends[k + 1].first;
      if (more == 0 || !(to - from > 4 * slack) || isThin(side, (from + to) / 2)) continue;
      return said(side, from, to, more < 0 ? "no cell has" : "too many cells have");
    }
    return {};
  }

 private:
  void addCell(std::size_t i) {
    const auto first = run_.diagram.neighbors.begin() + static_cast<std::ptrdiff_t>(run_.begin(i));
    const auto last = first + static_cast<std::ptrdiff_t>(run_.edges(i));
    if (std::none_of(first, last, [](std::int64_t neighbor) { return neighbor < 0; })) return;
    const double rounding = run_.rounding(i), slack = rounding + run_.ties(run_.reach(i));
    CellRings(run_, i).eachEdge([&](std::size_t e, Point p, Point q) {
      const std::int64_t neighbor = run_.diagram.neighbors[e];
      if (neighbor >= 0) return;
      if (neighbor != wall_outline) {
        addTo(outline_.edges().size() + static_cast<std::size_t>(-1 - neighbor), p, q, slack);
        return;
      }
      eachAlong(outline_, p, q, rounding, [&](std::size_t side, double from, double to) {
        if (const auto wall = wallOf(walls_, edge(side), rounding_)) {
          addTo(outline_.edges().size() + *wall, placeAlong(edge(side), from), placeAlong(edge(side), to),
                slack);
        } else {
          had_.push_back({side, from, to, slack});
        }
      });
    });
  }

  void addTo(std::size_t side, Point p, Point q, double slack) {
    had_.push_back({side, alongEdge(edge(side), p), alongEdge(edge(side), q), slack});
  }

  /// Whether the domain is no wider there than rounding: another side runs along it in the opposite
  /// direction.
  [[nodiscard]] bool isThin(std::size_t side, double along) const {
    const Point p = placeAlong(edge(side), along), way = edge(side).b - edge(side).a;
    bool thin = false;
    outline_.eachNear(p, 4 * rounding_, [&](std::uint32_t k) {
      const Edge& other = outline_.edges()[k];
      thin = thin || (distance(p, other.a, other.b) <= 4 * rounding_ && dot(other.b - other.a, way) < 0);
    });
    return thin;
  }

  [[nodiscard]] const Edge& edge(std::size_t side) const {
    const std::size_t edges = outline_.edges().size();
    return side < edges ? outline_.edges()[side] : walls_.edges[side - edges];
  }

  [[nodiscard]] std::string said(std::size_t side, double from, double to, std::string_view who) const {
    const auto at = [&](double along) { return run_.text(placeAlong(edge(side), along)); };
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
  broken.expectEach("edges", run, [&](std::size_t i) { return wrongAlong(run, outline, i); });
  const Border border(run, outline);
  broken.expect("outline", border.sides(), run.threads, [&](std::size_t side) { return border.wrong(side); });
}

}  // namespace vorpipe::core::checks
