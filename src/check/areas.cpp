#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "base/parallel.h"
#include "check/outline.h"
#include "check/places.h"

namespace vorpipe::core::checks {
namespace {

/// Promised accuracy of areas: relative to themselves, and to the mean cell.
constexpr double of_area = 1e-5, of_mean = 1e-9;

/// The part of the domain that the bisectors with all other sites leave for one site.
class CutOut {
 public:
  CutOut(const CheckedCells& run, std::size_t i) : run_(run), site_(run.site(i)) {
    const Box& box = run.domain;
    origin_ = {std::clamp(site_.x, box.xmin, box.xmax), std::clamp(site_.y, box.ymin, box.ymax)};
    const Point low = Point{box.xmin, box.ymin} - origin_, high = Point{box.xmax, box.ymax} - origin_;
    ring_ = {low, {high.x, low.y}, high, {low.x, high.y}};
    measureReach();
    cutByAllBut(i);
  }

  [[nodiscard]] const std::vector<Point>& ring() const { return ring_; }
  /// Its points are relative to this.
  [[nodiscard]] Point origin() const { return origin_; }
  /// Rounding of the cutting bisectors: worst for far heavy sites.
  [[nodiscard]] double rounding() const { return rounding_; }

 private:
  /// Cuts first by a few sites from all over the input. Sites in rows would each cut off a little more than
  /// the previous one, until the row of site i. Steps of the golden section of the input are evenly spread
  /// for any number of steps. Unlike steps of a power of two they do not hit the same row repeatedly. Cutting
  /// by a site twice changes nothing.
  void cutByAllBut(std::size_t i) {
    const std::size_t size = run_.size(), some = size / 32;
    const auto far_apart = static_cast<std::size_t>(0.618033988749895 * static_cast<double>(size)) | 1;
    const auto cutByOther = [&](std::size_t j) {
      if (j != i && run_.diagram.owner[j] == j) cutBy(j, run_.way(i, j), run_.weightDifference(i, j));
    };
    for (std::size_t k = 0; k < some; ++k) cutByOther(k * far_apart % size);
    for (std::size_t j = 0; j < size; ++j) cutByOther(j);
  }

  void cutBy(std::size_t j, Point way, double weight_difference) {
    const double away = length(way), middle = (away + weight_difference / away) / 2;
    if (middle >= reach_) return;
    const Point normal{way.x / away, way.y / away};
    const double offset = middle - dot(origin_ - site_, normal);
    if (std::ranges::none_of(ring_, [&](Point p) { return dot(p, normal) > offset; })) return;
    cutRing(normal, offset, ring_);
    rounding_ = std::max(rounding_, run_.rounding(j));
    measureReach();
  }

  void measureReach() {
    reach_ = 0;
    const Point away = site_ - origin_;
    for (const Point p : ring_) reach_ = std::max(reach_, length(p - away));
  }

  const CheckedCells& run_;
  Point site_, origin_{};
  std::vector<Point> ring_;
  double reach_ = 0;  ///< from the site
  double rounding_ = 0;
};

double perimeterOf(std::span<const Point> ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    sum += length(ring[k + 1 < ring.size() ? k + 1 : 0] - ring[k]);
  return sum;
}

double meanArea(const CheckedCells& run) {
  return areaSum(run.diagram) * run.scale * run.scale / static_cast<double>(run.diagram.report.ok);
}

/// How long and thin a cell may be: its area relative to the squared distance to its nearest neighbor.
double thinness(const CheckedCells& run, std::size_t i) {
  if (!run.ok(i)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t e = run.begin(i); e < run.end(i); ++e)
    if (run.diagram.neighbors[e] >= 0) nearest = std::min(nearest, length(run.neighborWay(i, e)));
  return run.diagram.area[i] * run.scale * run.scale / (nearest * nearest);
}

/// The apparently thinnest cells: as many as can quickly be cut out, each by all sites.
std::vector<std::size_t> thinnestCells(const CheckedCells& run) {
  constexpr std::size_t most = 64, most_cuts = 1 << 26;
  std::vector<double> thin(run.size());
  parallelFor(run.size(), 4096, run.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) thin[i] = thinness(run, i);
  });
  std::vector<std::size_t> cells(run.size());
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = i;
  const std::size_t count =
      std::min({run.size(), most, most_cuts / std::max<std::size_t>(run.size(), 1) + 1});
  const auto last = cells.begin() + static_cast<std::ptrdiff_t>(count);
  std::ranges::partial_sort(cells, last, [&](std::size_t a, std::size_t b) {
    return thin[a] != thin[b] ? thin[a] > thin[b] : a < b;
  });
  cells.resize(count);
  return cells;
}

}  // namespace

std::string wrongArea(const CheckedCells& run, const CheckedOutline* outline, std::size_t i) {
  if (!run.ok(i)) return {};
  const CutOut cell(run, i);
  const double area = outline != nullptr ? outline->area(cell.ring(), cell.origin()) : areaOf(cell.ring());
  double rounding = std::max(run.rounding(i), cell.rounding());
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    const auto neighbor = run.diagram.neighbors[e];
    if (neighbor >= 0) rounding = std::max(rounding, run.rounding(static_cast<std::size_t>(neighbor)));
  }
  // If rounding may have left next to nothing, the cell is known only to lie in the domain.
  const Box& box = run.domain;
  double around = perimeterOf(cell.ring());
  if (!(area > rounding * around)) around = 2 * (box.xmax - box.xmin + box.ymax - box.ymin);
  const double said = run.diagram.area[i] * run.scale * run.scale;
  const double slack = of_area * area + of_mean * meanArea(run) + rounding * around;
  if (std::abs(said - area) <= slack) return {};
  return fmt::format("site {} has {}, the bisectors with all others enclose {}", i, run.diagram.area[i],
                     area / run.scale / run.scale);
}

void checkThinAreas(const CheckedCells& run, const CheckedOutline* outline, Broken& broken) {
  // NaN is reported by the check of the sum.
  if (run.repeats() || run.diagram.report.ok == 0 || !std::isfinite(areaSum(run.diagram))) return;
  const auto cells = thinnestCells(run);
  broken.expect("areas", cells.size(), run.threads,
                [&](std::size_t k) { return wrongArea(run, outline, cells[k]); });
}

}  // namespace vorpipe::core::checks
