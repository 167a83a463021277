#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "check/checks.h"
#include "check/places.h"

namespace vorpipe::core::checks {
namespace {

constexpr std::size_t sampled_cells = 10'000;
/// Sampled vertices per cell; few cells have more.
constexpr std::size_t most_vertices = 16;
constexpr std::size_t searches_of_task = 64;

/// Cells with an area, in random order, without repetition: all, or `sampled_cells` of them.
std::vector<std::uint32_t> sampleCells(const CheckedCells& run, Random& random) {
  std::vector<std::uint32_t> cells;
  for (std::uint32_t i = 0; i < run.size(); ++i) {
    if (run.ok(i)) cells.push_back(i);
  }
  const std::size_t count = std::min(cells.size(), sampled_cells);
  for (std::size_t k = 0; k < count; ++k) std::swap(cells[k], cells[k + random() % (cells.size() - k)]);
  cells.resize(count);
  return cells;
}

/// The sampled places of the cell of site i: its centroid and vertices. Any cell that overlaps a convex one
/// contains a vertex of it.
std::vector<Point> placesOf(const CheckedCells& run, std::size_t i) {
  const Point centroid = run.diagram.centroid[i];
  std::vector<Point> places{{centroid.x * run.scale, centroid.y * run.scale}};
  if (run.detail == Detail::measures) return places;
  const std::size_t step = 1 + run.edges(i) / most_vertices;
  for (std::size_t v = run.begin(i); v < run.end(i); v += step) places.push_back(run.vertex(v));
  return places;
}

/// The nearest image for each place of some cells. Around a vertex that many cells share, as the center of
/// sites on a circle, all their sites are equally near and must be compared; once is enough.
class NearestOfPlaces {
 public:
  NearestOfPlaces(const CheckedCells& run, const NearestSite& nearest) : run_(run), nearest_(nearest) {}

  void add(std::span<const std::uint32_t> cells) {
    std::vector<Point> places;
    for (const auto i : cells) std::ranges::copy(placesOf(run_, i), std::back_inserter(places));
    std::ranges::sort(places, {}, [](Point p) { return PlaceKey(p); });
    const auto equal = [](Point p, Point q) { return PlaceKey(p) == PlaceKey(q); };
    places.erase(std::unique(places.begin(), places.end(), equal), places.end());
    std::erase_if(places,
                  [&](Point p) { return std::ranges::binary_search(cached_, PlaceKey(p), {}, keyOf); });
    const std::size_t before = cached_.size();
    cached_.resize(before + places.size());
    parallelFor(places.size(), searches_of_task, run_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        cached_[before + k] = {places[k], nearestImage(run_, nearest_, places[k])};
    });
    std::ranges::inplace_merge(cached_, cached_.begin() + static_cast<std::ptrdiff_t>(before), {}, keyOf);
  }

  /// The nearest image for a place of those cells.
  [[nodiscard]] const NearImage& at(Point p) const {
    return std::ranges::lower_bound(cached_, PlaceKey(p), {}, keyOf)->nearest;
  }

 private:
  struct Cached {
    Point place;
    NearImage nearest;
  };
  static PlaceKey keyOf(const Cached& cached) { return PlaceKey(cached.place); }

  const CheckedCells& run_;
  const NearestSite& nearest_;
  std::vector<Cached> cached_;  ///< by place
};

/// Calls `search(begin, end)` for parts of [0, count), from its beginning, as time allows; returns how far it
/// came. Each part is as long as all before it, so its cost is predictable.
template <class Search>
std::size_t searchInTime(std::size_t count, const NearestSite& nearest, const Search& search) {
  constexpr std::size_t at_least = 64;
  // About five seconds of CPU time.
  constexpr std::uint64_t most_visited = 30'000'000;
  const std::uint64_t before = nearest.visited();
  std::size_t done = 0;
  while (done < count && 2 * (nearest.visited() - before) <= most_visited) {
    const std::size_t next = std::min(count, done + std::max(done, at_least));
    search(done, next);
    done = next;
  }
  return done;
}

std::string wrongPlace(const CheckedCells& run, const NearImage& near, std::size_t i, Point p) {
  const Point way = run.way(i, near.site, near.shift);
  if (way == Point{0, 0} || (run.diagram.owner[near.site] == i && length(way) <= run.rounding(i))) return {};
  const double rounding = run.rounding(i) + run.rounding(near.site);
  const double beyond = run.beyond(i, near.site, p, near.shift);
  return run.wrongAtAnyReach(i, [&](double reach) -> std::string {
    // The original position of ends of edges that an outline cut is unknown.
    const double own_reach = run.outline != nullptr ? run.shorter_side
                             : run.weighted         ? std::max(reach, length(way))
                                                    : length(p - run.site(i));
    if (beyond <= run.ties(own_reach) + rounding) return {};
    return fmt::format("{} in the cell of site {} is nearer to site {}", run.text(p), i, near.site);
  });
}

std::string wrongCell(const CheckedCells& run, const NearestOfPlaces& nearest, std::size_t i) {
  for (const Point p : placesOf(run, i)) {
    std::string wrong = wrongPlace(run, nearest.at(p), i, p);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

/// Distance of p from the polygon of site i; 0 inside. A short edge may point anywhere, so the side of its
/// line on which p lies means nothing.
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

/// Whether p lies in the cell of one of the nearest images, or within the distance by which ties may have
/// moved a vertex.
bool isInOneOf(const CheckedCells& run, const std::vector<NearImage>& near, Point p) {
  std::vector<std::pair<std::uint32_t, double>> off;
  for (const NearImage& image : near) {
    // Relative to the site's own position, then to its owner's.
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

std::string wrongSample(const CheckedCells& run, const NearestSite& nearest, Point p) {
  const auto near = nearestImages(run, nearest, p);
  if (isInOneOf(run, near, p)) return {};
  return fmt::format("{} does not lie in the cell of its nearest site {}", run.text(p),
                     run.diagram.owner[near.front().site]);
}

}  // namespace

void checkNearestInCells(const CheckedCells& run, const NearestSite& nearest, Random& random,
                         Broken& broken) {
  std::vector<std::uint32_t> cells = sampleCells(run, random);
  NearestOfPlaces nearest_of(run, nearest);
  cells.resize(searchInTime(cells.size(), nearest, [&](std::size_t begin, std::size_t end) {
    nearest_of.add(std::span(cells).subspan(begin, end - begin));
  }));
  std::ranges::sort(cells);
  broken.expect("nearest sites", cells.size(), run.threads,
                [&](std::size_t k) { return wrongCell(run, nearest_of, cells[k]); });
}

void checkNearest(const CheckedCells& run, const NearestSite& nearest, Broken& broken) {
  Random random(1);
  checkNearestInCells(run, nearest, random, broken);
  if (run.detail == Detail::measures) return;
  const std::vector<Point> places = samplePlaces(run, random);
  std::vector<std::string> wrong(places.size());
  const std::size_t searched = searchInTime(places.size(), nearest, [&](std::size_t begin, std::size_t end) {
    parallelFor(end - begin, searches_of_task, run.threads, [&](std::size_t from, std::size_t to) {
      for (std::size_t k = begin + from; k < begin + to; ++k) wrong[k] = wrongSample(run, nearest, places[k]);
    });
  });
  broken.expect("nearest sites", searched, run.threads, [&](std::size_t k) { return wrong[k]; });
}

}  // namespace vorpipe::core::checks
