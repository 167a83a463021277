#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "check/checks.h"
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
  parallelEach(run.size(), 4096, run.threads, [&](std::size_t i) { thin[i] = thinness(run, i); });
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

/// Relative rounding error of a mass, from adding up pixels.
constexpr double mass_slack = 1e-9;

/// How much of the area of cell i may be in another pixel. This is rounding only, since masses use the same
/// corners as areas. Without polygons it is the promised accuracy of areas.
double areaSlack(const CheckedCells& run, double mean, std::size_t i) {
  if (run.detail == Detail::measures) return 1e-9 * mean + 1e-5 * run.diagram.area[i];
  const double longest = run.diagram.perimeter[i] * run.scale + run.ties(run.shorter_side);
  return mass_slack * run.diagram.area[i] + run.rounding(i) * longest / run.scale / run.scale;
}

struct Range {
  double least, most;
};

std::string wrongMass(const CheckedCells& run, Range densities, double mean, std::size_t i) {
  const Diagram& d = run.diagram;
  const double mass = d.mass[i];
  if (!run.ok(i)) {
    return mass == 0 && d.mass_centroid[i] == d.centroid[i]
               ? std::string()
               : fmt::format("site {} has no cell, but a mass of {}", i, mass);
  }
  const double slack = areaSlack(run, mean, i);
  if (mass >= densities.least * (d.area[i] - slack) && mass <= densities.most * (d.area[i] + slack))
    return {};
  return fmt::format("site {} has {} on an area of {}, of densities from {} to {}", i, mass, d.area[i],
                     densities.least, densities.most);
}

std::string wrongCenter(const CheckedCells& run, std::size_t i) {
  if (!run.ok(i) || run.edges(i) == 0) return {};
  const std::span vertices(run.diagram.vertices);
  const Box box = boxOf(vertices.subspan(run.begin(i), run.edges(i)));
  const Point center = run.diagram.mass_centroid[i];
  return run.wrongAtAnyReach(i, [&](double reach) -> std::string {
    const double slack = (run.ties(reach) + run.rounding(i)) / run.scale;
    if (center.x >= box.xmin - slack && center.x <= box.xmax + slack && center.y >= box.ymin - slack &&
        center.y <= box.ymax + slack) {
      return {};
    }
    return fmt::format("site {} has its center at ({}, {}), beyond the cell", i, center.x, center.y);
  });
}

/// The length of the part of pixel k, of `count` pixels from low to high, that lies between two places.
double lengthBetween(double low, double high, int count, int k, double from, double to) {
  const double size = (high - low) / count;
  const double begin = std::max(low + k * size, from), end = std::min(low + (k + 1) * size, to);
  return std::max(0.0, end - begin);
}

/// The mass in the domain's box of a density with its own box.
double massOfPlaced(const Density& density, const Box& domain) {
  const Box& box = *density.box;
  double sum = 0;
  for (int row = 0; row < density.height; ++row) {
    // Rows count from the top.
    const double height =
        lengthBetween(box.ymin, box.ymax, density.height, density.height - 1 - row, domain.ymin, domain.ymax);
    const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(density.width);
    for (int column = 0; column < density.width && height > 0; ++column) {
      sum += height * density.values[first + static_cast<std::size_t>(column)] *
             lengthBetween(box.xmin, box.xmax, density.width, column, domain.xmin, domain.xmax);
    }
  }
  return sum;
}

/// The mass in the domain's box.
double massOf(const CheckedCells& run) {
  const Density& density = *run.density;
  const Box& box = run.caller_domain;
  if (density.box) return massOfPlaced(density, box);
  const double pixel = (box.xmax - box.xmin) / density.width * ((box.ymax - box.ymin) / density.height);
  return std::accumulate(density.values.begin(), density.values.end(), 0.0) * pixel;
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

void checkMass(const CheckedCells& run, Broken& broken) {
  if (run.density == nullptr) return;
  const auto [least, most] = std::ranges::minmax(run.density->values);
  const Range densities{run.density->box ? 0 : least, most};
  const double mean =
      areaSum(run.diagram) / static_cast<double>(std::max<std::uint64_t>(run.diagram.report.ok, 1));
  broken.expectEach("masses", run, [&](std::size_t i) { return wrongMass(run, densities, mean, i); });
  if (run.detail != Detail::measures) {
    broken.expectEach("masses", run, [&](std::size_t i) { return wrongCenter(run, i); });
  }
  const auto& mass = run.diagram.mass;
  const double sum = std::accumulate(mass.begin(), mass.end(), 0.0), whole = massOf(run);
  if (!std::isfinite(whole)) return;
  // The two cells of an edge may have rounded it differently.
  const double apart = 64 * epsilon * run.largest * static_cast<double>(run.size());
  const Box& box = run.caller_domain;
  const double slack = mass_slack * whole + apart * most * (box.xmax - box.xmin) * (box.ymax - box.ymin);
  const bool right = run.outline != nullptr ? sum <= whole + slack : std::abs(sum - whole) <= slack;
  if (!right) broken.add("masses", fmt::format("they add up to {}, the density to {}", sum, whole));
}

}  // namespace vorpipe::core::checks
