#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "check/checks.h"

namespace vorpipe::core::checks {
namespace {

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

void checkMass(const CheckedCells& run, Broken& broken) {
  if (run.density == nullptr) return;
  const auto [least, most] = std::ranges::minmax(run.density->values);
  const Range densities{run.density->box ? 0 : least, most};
  const double mean =
      areaSum(run.diagram) / static_cast<double>(std::max<std::uint64_t>(run.diagram.report.ok, 1));
  broken.expect("masses", run.size(), run.threads,
                [&](std::size_t i) { return wrongMass(run, densities, mean, i); });
  if (run.detail != Detail::measures) {
    broken.expect("masses", run.size(), run.threads, [&](std::size_t i) { return wrongCenter(run, i); });
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
