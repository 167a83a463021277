/// A run's result for the checks. Nothing here relies on the code that computed it.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/parallel.h"
#include "vorpipe.h"

namespace vorpipe::core::checks {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Offset of an image from its site in periods, along x and along y.
using Shift = std::array<std::int32_t, 2>;

inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double length(Point a) { return std::sqrt(dot(a, a)); }

/// How far ties, each shorter than 1e-6 of this unit, may move a vertex; the unit is the cell's reach, or the
/// domain's shorter side if that is less. A vertex stands for all corners that ties join. With weights there
/// are more, because many cells may nearly meet in a point.
inline constexpr double tie_slack = 1e-5, weighted_tie_slack = 1e-4;

/// How far p lies beyond the bisector of two sites, seen from the first, which is at `from` and heavier by
/// `weight_difference`; d is the vector to the other.
inline double beyondBisector(Point d, Point from, double weight_difference, Point p) {
  return dot(p - from, d) / length(d) - (length(d) + weight_difference / length(d)) / 2;
}

/// Rounds a scaled coordinate near an axis, of a site or of a wall, to a multiple of 2^-199.
inline double countedCoordinate(double scaled) {
  return std::abs(scaled) < 0x1p-148 ? std::rint(scaled * 0x1p199) * 0x1p-199 : scaled;
}

/// The power of two that scales the domain's longer side into [1, 2), so that squared lengths stay in a
/// double's range.
inline double scaleOf(const Box& domain) {
  constexpr int most = 1000;  // beyond, the power itself is out of range
  int exponent = 0;
  std::frexp(std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin), &exponent);
  return std::ldexp(1.0, std::clamp(1 - exponent, -most, most));
}

/// The positions of a periodic domain's corners relative to its sites, lower left and upper right: the
/// caller's, rounded as sites are. Errors: those of wrapped().
Result<std::array<Point, 2>> placedCorners(const Box& domain, Periodic periodic);

/// The sites of a run and its domain, scaled. Sites of a periodic domain are as wrapped() returns them.
struct CheckedSites {
  CheckedSites(const Sites& of, const Box& box, Periodic periodic, int thread_count)
      : sites(of),
        caller_domain(box),
        repeats_x(periodic == Periodic::x || periodic == Periodic::xy),
        repeats_y(periodic == Periodic::y || periodic == Periodic::xy),
        threads(threadCount(thread_count)),
        scale(scaleOf(box)) {
    domain = {countedCoordinate(box.xmin * scale), countedCoordinate(box.ymin * scale),
              countedCoordinate(box.xmax * scale), countedCoordinate(box.ymax * scale)};
    largest = std::max(
        {std::abs(domain.xmin), std::abs(domain.xmax), std::abs(domain.ymin), std::abs(domain.ymax)});
    shorter_side = std::min(domain.xmax - domain.xmin, domain.ymax - domain.ymin);
    period = {domain.xmax - domain.xmin, domain.ymax - domain.ymin};
    if (repeats()) {
      if (const auto placed = placedCorners(box, periodic)) corners = *placed;
      if (repeats_x) period.x = (corners[1].x - corners[0].x) * scale;
      if (repeats_y) period.y = (corners[1].y - corners[0].y) * scale;
    }
    weighted =
        std::adjacent_find(of.weight.begin(), of.weight.end(), std::not_equal_to<>()) != of.weight.end();
  }
  [[nodiscard]] std::size_t size() const { return sites.size(); }
  [[nodiscard]] Point site(std::size_t i) const {
    return {sites.x[i] * scale - base.x, sites.y[i] * scale - base.y};
  }
  /// The vector from site i to the image of site j at `shift` periods from it. For sites near each other it
  /// is exact, whatever the origin: a slightly turned bisector is far off at a distance from its sites. In a
  /// periodic domain, positions and periods are multiples of one quantum.
  [[nodiscard]] Point way(std::size_t i, std::size_t j, Shift shift = {0, 0}) const {
    return {(sites.x[j] - sites.x[i]) * scale + shift[0] * period.x,
            (sites.y[j] - sites.y[i]) * scale + shift[1] * period.y};
  }
  /// Moves the origin to the domain's corner, along axes where that rounds no site in it or beside it. Pixels
  /// are fractions of the domain, and far from the origin doubles may be unable to represent their centers.
  void countFromCorner() {
    const auto along = [](double low, double high) {
      const bool is_far =
          (low > 0) == (high > 0) && std::min(std::abs(low), std::abs(high)) >= 2 * (high - low);
      return is_far ? low : 0.0;
    };
    base = {along(domain.xmin, domain.xmax), along(domain.ymin, domain.ymax)};
    domain = {domain.xmin - base.x, domain.ymin - base.y, domain.xmax - base.x, domain.ymax - base.y};
  }
  /// How far ties may move a vertex of a cell of this reach.
  [[nodiscard]] double ties(double reach) const {
    return (weighted ? weighted_tie_slack : tie_slack) * std::min(reach, shorter_side);
  }
  [[nodiscard]] bool repeats() const { return repeats_x || repeats_y; }
  /// Whether cells may reach so far that ties become as long as a period.
  [[nodiscard]] bool mayBeNarrow() const { return shortestPeriod() < 100 * tie_slack; }
  [[nodiscard]] double shortestPeriod() const {
    constexpr double none = std::numeric_limits<double>::infinity();
    return std::min(repeats_x ? period.x : none, repeats_y ? period.y : none);
  }
  /// p moved by `shift` periods.
  [[nodiscard]] Point moved(Point p, Shift shift) const {
    return {p.x + shift[0] * period.x, p.y + shift[1] * period.y};
  }
  /// How much heavier site i is than site j.
  [[nodiscard]] double weightDifference(std::size_t i, std::size_t j) const {
    return weighted ? (sites.weight[i] - sites.weight[j]) * scale * scale : 0;
  }
  /// How far p lies beyond the bisector of site i and the image of site j at `shift` periods.
  [[nodiscard]] double beyond(std::size_t i, std::size_t j, Point p, Shift shift = {0, 0}) const {
    return beyondBisector(way(i, j, shift), site(i), weightDifference(i, j), p);
  }
  /// p in the caller's units, for messages.
  [[nodiscard]] std::string text(Point p) const { return fmt::format("({}, {})", p.x / scale, p.y / scale); }
  [[nodiscard]] bool inDomain(Point p) const {
    return p.x >= domain.xmin && p.x <= domain.xmax && p.y >= domain.ymin && p.y <= domain.ymax;
  }
  /// The possible rounding error of a coordinate near site i.
  [[nodiscard]] double rounding(std::size_t i) const {
    constexpr double steps = 16;
    return steps * epsilon * std::max({largest, std::abs(sites.x[i] * scale), std::abs(sites.y[i] * scale)});
  }

  const Sites& sites;
  Box caller_domain;
  bool repeats_x, repeats_y;
  int threads;
  double scale;
  Box domain{};
  Point base{0, 0};    ///< origin of the scaled positions of sites and of the domain
  double largest = 0;  ///< largest absolute coordinate of the domain
  double shorter_side = 0;
  Point period{0, 0};                ///< along axes that repeat; along others the domain's side
  std::array<Point, 2> corners{};    ///< those of placedCorners(), if the domain repeats
  bool weighted = false;             ///< the weights are not all equal
  const Outline* outline = nullptr;  ///< of the domain, if it has one
};

/// Cells of such sites. Vertices and sites are scaled; other lengths are as in the diagram.
struct CheckedCells : CheckedSites {
  CheckedCells(const Sites& of, const CellsOptions& options, const Diagram& result, int thread_count)
      : CheckedSites(of, options.domain, options.periodic, thread_count),
        diagram(result),
        detail(options.detail) {
    if (!options.outline.empty()) outline = &options.outline;
    if (!options.density.values.empty()) density = &options.density;
  }

  [[nodiscard]] bool ok(std::size_t i) const { return diagram.status[i] == Status::ok; }
  /// The vertices and edges of cell i are begin(i) .. end(i) - 1.
  [[nodiscard]] std::size_t begin(std::size_t i) const { return diagram.cell_offsets[i]; }
  [[nodiscard]] std::size_t end(std::size_t i) const { return diagram.cell_offsets[i + 1]; }
  [[nodiscard]] std::size_t edges(std::size_t i) const { return end(i) - begin(i); }
  /// The successor of vertex or edge e of cell i, and its predecessor.
  [[nodiscard]] std::size_t next(std::size_t i, std::size_t e) const {
    return e + 1 < end(i) ? e + 1 : begin(i);
  }
  [[nodiscard]] std::size_t previous(std::size_t i, std::size_t e) const {
    return (e > begin(i) ? e : end(i)) - 1;
  }
  [[nodiscard]] Point vertex(std::size_t e) const {
    return {diagram.vertices[e].x * scale, diagram.vertices[e].y * scale};
  }
  /// The offset, in widths and heights of the domain, of the neighbor across edge e from its own position.
  [[nodiscard]] Shift shift(std::size_t e) const {
    return repeats() ? diagram.neighbor_shifts[e] : Shift{0, 0};
  }
  /// The vector from site i to the neighbor across edge e of its cell, which is a site.
  [[nodiscard]] Point neighborWay(std::size_t i, std::size_t e) const {
    return way(i, static_cast<std::size_t>(diagram.neighbors[e]), shift(e));
  }
  /// How far from its site the sites that determine the vertices of cell i may be; ties are measured by this.
  /// Without weights, neighbors are at most twice as far as vertices.
  [[nodiscard]] double reach(std::size_t i) const {
    double reach = 0;
    const Point own = site(i);
    for (std::size_t e = begin(i); e < end(i); ++e) {
      if (detail != Detail::measures) reach = std::max(reach, length(vertex(e) - own));
      if (!weighted || diagram.neighbors[e] < 0) continue;
      reach = std::max(reach, length(neighborWay(i, e)));
    }
    return reach;
  }

  /// The same with the neighbors of neighbors: a vertex also stands for ties among these.
  [[nodiscard]] double widerReach(std::size_t i) const {
    double wider = reach(i);
    for (std::size_t e = begin(i); e < end(i); ++e) {
      if (diagram.neighbors[e] < 0) continue;
      const auto j = static_cast<std::size_t>(diagram.neighbors[e]);
      wider = std::max(wider, length(neighborWay(i, e)) + reach(j));
    }
    return wider;
  }

  /// The same with every site whose bisector passes so close to a vertex of cell i that ties with it may move
  /// the vertex. The cells nearly meet there, and ties may have removed all edges between them.
  [[nodiscard]] double widestReach(std::size_t i) const {
    std::call_once(widest_asked_, [this] { widest_.assign(size(), 0); });
    const std::atomic_ref known(widest_[i]);
    const double before = known.load(std::memory_order_relaxed);
    if (before > 0) return before;
    const double widest = findWidestReach(i);
    known.store(widest, std::memory_order_relaxed);
    return widest;
  }

  /// What `wrong(reach)` reports for cell i; with weights, only if it reports something for all three
  /// reaches.
  template <class Wrong>
  [[nodiscard]] std::string wrongAtAnyReach(std::size_t i, const Wrong& wrong) const {
    std::string text = wrong(reach(i));
    if (text.empty() || !weighted) return text;
    text = wrong(widerReach(i));
    return text.empty() ? text : wrong(widestReach(i));
  }

  const Diagram& diagram;
  Detail detail;
  const Density* density = nullptr;  ///< if there is one

 private:
  [[nodiscard]] double findWidestReach(std::size_t i) const {
    double widest = widerReach(i);
    // A reach beyond the domain's shorter side makes ties no longer.
    for (std::size_t j = 0; j < size() && widest < shorter_side; ++j) {
      const double away = length(way(i, j));
      if (!(away > widest)) continue;
      for (std::size_t v = begin(i); v < end(i); ++v) {
        if (std::abs(beyond(i, j, vertex(v))) <= ties(away)) widest = away;
      }
    }
    return widest;
  }

  mutable std::once_flag widest_asked_;
  mutable std::vector<double> widest_;  ///< by cell, 0 until it is asked for
};

/// The lines of a check: one for each promise that is broken.
class Broken {
 public:
  void add(std::string_view promise, const std::string& what) {
    lines_.push_back(std::string(promise).append(": ").append(what));
  }
  [[nodiscard]] bool none() const { return lines_.empty(); }
  [[nodiscard]] std::vector<std::string> take() { return std::move(lines_); }

  /// Adds a line if `test(i)`, what is wrong with i or nothing, is not empty for some i below count. The line
  /// has the first of them, and their number. Returns whether the promise holds.
  template <class Test>
  bool expect(std::string_view promise, std::size_t count, int threads, const Test& test) {
    constexpr std::size_t grain = 4096;
    std::mutex mutex;
    std::size_t first = count, wrong = 0;
    std::string text;
    parallelEach(count, grain, threads, [&](std::size_t i) {
      std::string what = test(i);
      if (what.empty()) return;
      const std::lock_guard lock(mutex);
      ++wrong;
      if (i < first) {
        first = i;
        text = std::move(what);
      }
    });
    if (wrong == 0) return true;
    if (wrong > 1) text += " (the first of " + std::to_string(wrong) + ")";
    add(promise, text);
    return false;
  }

  /// The same for every site.
  template <class Test>
  bool expectEach(std::string_view promise, const CheckedSites& run, const Test& test) {
    return expect(promise, run.size(), run.threads, test);
  }

 private:
  std::vector<std::string> lines_;
};

}  // namespace vorpipe::core::checks
