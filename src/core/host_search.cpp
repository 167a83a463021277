#include "core/host_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pack.h"

namespace vorpipe {
namespace {

constexpr std::size_t first_neighbors = 12;
/// Cells are completed at every first_stride-th place first, then ever closer together.
constexpr std::size_t first_stride = 1024;
constexpr std::size_t stride_ratio = 4;
/// A vertex that lies beyond a bisector by less than this part of its distance is on it.
constexpr double vertex_rounding = 1e-13;

/// How far the point p lies beyond the bisector of site and other, from exact differences.
double beyondBisector(const SiteSet& sites, Point p, std::uint32_t site, std::uint32_t other) {
  const double dx = sites.x[other] - sites.x[site];
  const double dy = sites.y[other] - sites.y[site];
  const double twice = ((p.x - sites.x[site]) + (p.x - sites.x[other])) * dx +
                       ((p.y - sites.y[site]) + (p.y - sites.y[other])) * dy;
  return 0.5 * twice / std::hypot(dx, dy);
}

void append(Candidates& list, std::uint32_t site, const std::vector<std::uint32_t>& others) {
  list.site.push_back(site);
  list.index.insert(list.index.end(), others.begin(), others.end());
  list.first.push_back(static_cast<std::uint32_t>(list.index.size()));
  list.reach.push_back(std::numeric_limits<double>::infinity());
}

/// A cell on its way to being complete.
struct Growing {
  std::size_t place;  ///< in `which`
  std::uint32_t site;
  std::vector<std::uint32_t> others;  ///< its candidates, nearest first; only ever grows, so the rounds end
  std::vector<Point> settled;         ///< vertices that no site is nearer to, by x, then y
};

bool before(Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// Puts `others` in order of distance from the site and drops what stands there twice.
void sortByDistance(const SiteSet& sites, std::uint32_t site, std::vector<std::uint32_t>& others) {
  const auto distance = [&](std::uint32_t i) {
    return std::hypot(sites.x[i] - sites.x[site], sites.y[i] - sites.y[site]);
  };
  std::sort(others.begin(), others.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double da = distance(a);
    const double db = distance(b);
    return da != db ? da < db : a < b;
  });
  others.erase(std::unique(others.begin(), others.end()), others.end());
}

Candidates listsOf(const std::vector<Growing>& cells) {
  Candidates candidates;
  for (const auto& cell : cells) append(candidates, cell.site, cell.others);
  return candidates;
}

/// The vertices that are not settled yet, and the site nearest to each.
struct Questions {
  std::vector<double> x, y;
  std::vector<std::uint32_t> nearest;
  std::vector<std::size_t> first{0};  ///< by cell
};

Questions askVertices(const SiteSet& sites, const FlannSearch& search, const std::vector<Growing>& cells,
                      const CellPolygons& polygons) {
  Questions questions;
  for (std::size_t e = 0; e < cells.size(); ++e) {
    const auto origin = cellOrigin(sites, cells[e].site);
    for (auto v = polygons.first[e]; v < polygons.first[e + 1]; ++v) {
      const Point p{polygons.x[v] + origin.x, polygons.y[v] + origin.y};
      if (std::binary_search(cells[e].settled.begin(), cells[e].settled.end(), p, before)) continue;
      questions.x.push_back(p.x);
      questions.y.push_back(p.y);
    }
    questions.first.push_back(questions.x.size());
  }
  questions.nearest.resize(questions.x.size());
  search.nearest(questions.x, questions.y, questions.nearest);
  return questions;
}

/// Adds the sites that are nearer to a vertex of the cell than its own; returns whether there were any.
bool grow(const SiteSet& sites, const Questions& questions, std::size_t e, Growing& cell) {
  const auto known = cell.others.size();
  for (auto q = questions.first[e]; q < questions.first[e + 1]; ++q) {
    const Point p{questions.x[q], questions.y[q]};
    const auto nearest = questions.nearest[q];
    const double distance = std::hypot(p.x - sites.x[cell.site], p.y - sites.y[cell.site]);
    if (nearest == cell.site || beyondBisector(sites, p, cell.site, nearest) <= vertex_rounding * distance) {
      cell.settled.push_back(p);
    } else {
      cell.others.push_back(nearest);
    }
  }
  std::sort(cell.settled.begin(), cell.settled.end(), before);
  sortByDistance(sites, cell.site, cell.others);
  return cell.others.size() > known;
}

/// The sites whose bisectors carry the edges of entry e.
std::vector<std::uint32_t> boundingSites(const CellPolygons& polygons, std::size_t e, const Growing& cell,
                                         const SiteSet& sites) {
  std::vector<std::uint32_t> bounding;
  for (auto v = polygons.first[e]; v < polygons.first[e + 1]; ++v) {
    if (polygons.line[v] >= 0) bounding.push_back(cell.others[static_cast<std::size_t>(polygons.line[v])]);
  }
  sortByDistance(sites, cell.site, bounding);
  return bounding;
}

Error tooManyEdges(const SiteSet& sites, std::uint32_t site) {
  return {ErrorCode::input,
          fmt::format("the cell of site {} has more than 131068 candidates, the most there is room for",
                      sites.id[site])};
}

Error tooFine(const SiteSet& sites, std::uint32_t site) {
  return {ErrorCode::input,
          fmt::format(
              "the cell of site {} is too fine for double precision: its neighbors are nearer to each other "
              "than rounding",
              sites.id[site])};
}

/// Whether the judge found nothing with an area: no edge at all, or a site outside the domain whose
/// cell touches it in a segment.
bool isEmpty(const SiteSet& sites, const CellPolygons& polygons, std::size_t e, std::uint32_t site) {
  if (polygons.status[e] == CellStatus::empty) return true;
  const auto origin = cellOrigin(sites, site);
  const bool outside = origin.x != sites.x[site] || origin.y != sites.y[site];
  return outside && polygons.first[e + 1] - polygons.first[e] < 3;
}

/// A complete cell: a polygon whose lines index `bounding`.
struct Complete {
  CellStatus status = CellStatus::missing;
  std::vector<std::uint32_t> bounding;
  std::vector<double> x, y;
  std::vector<std::int32_t> line;
};

Complete complete(const SiteSet& sites, const CellPolygons& polygons, std::size_t e, const Growing& cell) {
  if (isEmpty(sites, polygons, e, cell.site)) return {CellStatus::empty, cell.others, {}, {}, {}};
  Complete done{CellStatus::certified, boundingSites(polygons, e, cell, sites), {}, {}, {}};
  for (auto v = polygons.first[e]; v < polygons.first[e + 1]; ++v) {
    done.x.push_back(polygons.x[v]);
    done.y.push_back(polygons.y[v]);
    auto line = polygons.line[v];
    if (line >= 0) {
      const auto other = cell.others[static_cast<std::size_t>(line)];
      const auto found = std::find(done.bounding.begin(), done.bounding.end(), other);
      line = static_cast<std::int32_t>(found - done.bounding.begin());
    }
    done.line.push_back(line);
  }
  return done;
}

/// The domain for a cell without vertices.
Box boundingBox(const SiteSet& sites, std::uint32_t site, const Complete& cell) {
  if (cell.x.empty()) return sites.domain;
  const auto origin = cellOrigin(sites, site);
  const auto [xmin, xmax] = std::minmax_element(cell.x.begin(), cell.x.end());
  const auto [ymin, ymax] = std::minmax_element(cell.y.begin(), cell.y.end());
  return {origin.x + *xmin, origin.y + *ymin, origin.x + *xmax, origin.y + *ymax};
}

/// Grows cells round by round until each is complete.
Result<void> completeCells(const SiteSet& sites, const FlannSearch& search, Backend& judge, int threads,
                           std::vector<Growing> active, std::vector<Complete>& done) {
  CellBatch<double> batch;
  CellPolygons polygons;
  while (!active.empty()) {
    packBatch(sites, listsOf(active), 0, active.size(), threads, batch);
    if (auto clipped = judge.cells(batch, polygons); !clipped) return clipped;
    const auto questions = askVertices(sites, search, active, polygons);
    std::vector<Growing> next;
    for (std::size_t e = 0; e < active.size(); ++e) {
      auto& cell = active[e];
      if (polygons.status[e] == CellStatus::overflow) return tl::unexpected(tooManyEdges(sites, cell.site));
      if (grow(sites, questions, e, cell)) {
        next.push_back(std::move(cell));
      } else if (polygons.status[e] == CellStatus::open && !isEmpty(sites, polygons, e, cell.site)) {
        return tl::unexpected(tooFine(sites, cell.site));
      } else {
        done[cell.place] = complete(sites, polygons, e, cell);
      }
    }
    active = std::move(next);
  }
  return {};
}

/// The cells at every stride-th place that are not done yet, begun with their nearest neighbors and
/// with what bounds the two done cells around them: along a row of long thin cells the far neighbors
/// of one are nearly those of the next.
std::vector<Growing> beginCells(const SiteSet& sites, const FlannSearch& search,
                                std::span<const std::uint32_t> which, std::size_t stride,
                                const std::vector<Complete>& done) {
  std::vector<Growing> cells;
  std::vector<std::uint32_t> begun;
  for (std::size_t place = 0; place < which.size(); place += stride) {
    if (done[place].status != CellStatus::missing) continue;
    cells.push_back({place, which[place], {}, {}});
    begun.push_back(which[place]);
  }
  const auto nearest = search.neighbors(begun, first_neighbors);
  for (std::size_t e = 0; e < cells.size(); ++e) {
    auto& cell = cells[e];
    cell.others.assign(nearest.index.begin() + nearest.first[e],
                       nearest.index.begin() + nearest.first[e + 1]);
    const auto left = cell.place - cell.place % (stride * stride_ratio);
    for (const auto place : {left, left + stride * stride_ratio}) {
      if (place >= which.size()) continue;
      const auto& seeds = done[place].bounding;
      std::copy_if(seeds.begin(), seeds.end(), std::back_inserter(cell.others),
                   [&](std::uint32_t other) { return other != cell.site; });
    }
    sortByDistance(sites, cell.site, cell.others);
  }
  return cells;
}

}  // namespace

Result<HostCells> findCells(const SiteSet& sites, const FlannSearch& search, Backend& judge,
                            std::span<const std::uint32_t> which, int threads) {
  std::vector<Complete> done(which.size());
  for (auto stride = first_stride; stride > 0; stride /= stride_ratio) {
    auto cells = beginCells(sites, search, which, stride, done);
    if (auto all = completeCells(sites, search, judge, threads, std::move(cells), done); !all) {
      return tl::unexpected(all.error());
    }
  }
  HostCells found;
  found.polygons.first.push_back(0);
  for (std::size_t place = 0; place < which.size(); ++place) {
    const auto& cell = done[place];
    append(found.candidates, which[place], cell.bounding);
    found.candidates.walls.push_back(boundingBox(sites, which[place], cell));
    auto& polygons = found.polygons;
    polygons.status.push_back(cell.status);
    polygons.x.insert(polygons.x.end(), cell.x.begin(), cell.x.end());
    polygons.y.insert(polygons.y.end(), cell.y.begin(), cell.y.end());
    polygons.line.insert(polygons.line.end(), cell.line.begin(), cell.line.end());
    polygons.first.push_back(static_cast<std::uint32_t>(polygons.x.size()));
  }
  return found;
}

}  // namespace vorpipe
