#include <fmt/core.h>

#include <algorithm>

#include "core/check/checks.h"
#include "core/check/places.h"

namespace vorpipe::core::checks {
namespace {

constexpr std::size_t sampled_cells = 10'000;
/// Of a cell; few have more.
constexpr std::size_t most_vertices = 16;

/// Cells with an area, each at most once: all, or `sampled_cells` of them.
std::vector<std::uint32_t> sampleCells(const CheckedCells& run, Random& random) {
  std::vector<std::uint32_t> cells;
  for (std::uint32_t i = 0; i < run.size(); ++i) {
    if (run.ok(i)) cells.push_back(i);
  }
  if (cells.size() <= sampled_cells) return cells;
  for (std::size_t k = 0; k < sampled_cells; ++k)
    std::swap(cells[k], cells[k + random() % (cells.size() - k)]);
  cells.resize(sampled_cells);
  return cells;
}

std::string wrongPlace(const CheckedCells& run, const NearestSite& nearest, std::size_t i, Point p) {
  const NearImage near = nearestImage(run, nearest, p);
  const Point way = run.way(i, near.site, near.shift);
  if (way == Point{0, 0} || (run.diagram.owner[near.site] == i && length(way) <= run.rounding(i))) return {};
  const double rounding = run.rounding(i) + run.rounding(near.site);
  const double beyond = beyondBisector(way, run.site(i), run.weightDifference(i, near.site), p);
  return run.wrongAtAnyReach(i, [&](double reach) -> std::string {
    const double own_reach = run.weighted ? std::max(reach, length(way)) : length(p - run.site(i));
    if (beyond <= run.ties(own_reach) + rounding) return {};
    return fmt::format("({}, {}) in the cell of site {} is nearer to site {}", p.x / run.scale,
                       p.y / run.scale, i, near.site);
  });
}

/// Any cell that reaches into a convex one holds a vertex of it.
std::string wrongCell(const CheckedCells& run, const NearestSite& nearest, std::size_t i) {
  const Point centroid = run.diagram.centroid[i];
  std::string wrong = wrongPlace(run, nearest, i, {centroid.x * run.scale, centroid.y * run.scale});
  if (run.detail == Detail::measures) return wrong;
  const std::size_t step = 1 + run.edges(i) / most_vertices;
  for (std::size_t v = run.begin(i); v < run.end(i) && wrong.empty(); v += step) {
    wrong = wrongPlace(run, nearest, i, run.vertex(v));
  }
  return wrong;
}

/// How far p lies from the polygon of site i; 0 inside. A short edge may point anywhere, so that the side of
/// its line on which p lies says nothing.
double distanceFromCell(const CheckedCells& run, std::size_t i, Point p) {
  bool inside = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    const Point a = run.vertex(e), b = run.vertex(run.next(i, e));
    inside = inside != crossesRay(p, a, b);
    nearest = std::min(nearest, distance(p, a, b));
  }
  return inside ? 0 : nearest;
}

/// Whether p lies in the cell of one of the nearest images, or as near to it as ties may have moved a vertex.
bool isInOneOf(const CheckedCells& run, const std::vector<NearImage>& near, Point p) {
  std::vector<std::pair<std::uint32_t, double>> off;
  for (const NearImage& image : near) {
    // Seen from the site's own place, and then from its owner's.
    const std::uint32_t owner = run.diagram.owner[image.site];
    off.emplace_back(owner, distanceFromCell(run, owner, p - (image.place - run.site(owner))));
  }
  const auto isIn = [&](double (CheckedCells::*reach)(std::size_t) const) {
    return std::ranges::any_of(off, [&](const auto& cell) {
      return cell.second <= run.ties((run.*reach)(cell.first)) + run.rounding(cell.first);
    });
  };
  return isIn(&CheckedCells::reach) || (run.weighted && isIn(&CheckedCells::widestReach));
}

}  // namespace

void checkNearest(const CheckedCells& run, const NearestSite& nearest, Broken& broken) {
  Random random(1);
  const auto cells = sampleCells(run, random);
  broken.expect("nearest sites", cells.size(), run.threads,
                [&](std::size_t k) { return wrongCell(run, nearest, cells[k]); });
  if (run.detail == Detail::measures) return;
  const std::vector<Point> places = samplePlaces(run, random);
  broken.expect("nearest sites", places.size(), run.threads, [&](std::size_t k) -> std::string {
    const Point p = places[k];
    const auto near = nearestImages(run, nearest, p);
    if (isInOneOf(run, near, p)) return {};
    return fmt::format("({}, {}) does not lie in the cell of its nearest site {}", p.x / run.scale,
                       p.y / run.scale, run.diagram.owner[near.front().site]);
  });
}

}  // namespace vorpipe::core::checks
