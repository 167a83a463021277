#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "core/check/checks.h"

namespace vorpipe::core::checks {
namespace {

/// Of a mass: what adding up pixels rounds off.
constexpr double mass_slack = 1e-9;

/// What the area of the vertices of cell i, from which its mass is, may differ by from that of its record.
double areaSlack(const CheckedCells& run, std::size_t i, double reach) {
  const double off = run.ties(reach) + run.rounding(i);
  return (off * run.diagram.perimeter[i] * run.scale + off * off) / run.scale / run.scale;
}

std::string wrongMass(const CheckedCells& run, double least, double most, std::size_t i) {
  const Diagram& d = run.diagram;
  const double mass = d.mass[i];
  if (!run.ok(i)) {
    return mass == 0 && d.mass_centroid[i] == d.centroid[i]
               ? std::string()
               : fmt::format("site {} has no cell, but a mass of {}", i, mass);
  }
  if (run.detail == Detail::measures) {
    return mass >= 0 && std::isfinite(mass) ? std::string() : fmt::format("site {} has {}", i, mass);
  }
  return run.wrongAtAnyReach(i, [&](double reach) -> std::string {
    const double slack = mass_slack * d.area[i] + areaSlack(run, i, reach);
    if (mass >= least * (d.area[i] - slack) && mass <= most * (d.area[i] + slack)) return {};
    return fmt::format("site {} has {} on an area of {}, of densities from {} to {}", i, mass, d.area[i],
                       least, most);
  });
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

/// The mass in the domain's box.
double massOf(const CheckedCells& run) {
  const Density& density = *run.density;
  const Box& box = run.caller_domain;
  const double pixel = (box.xmax - box.xmin) / density.width * ((box.ymax - box.ymin) / density.height);
  return std::accumulate(density.values.begin(), density.values.end(), 0.0) * pixel;
}

}  // namespace

void checkMass(const CheckedCells& run, Broken& broken) {
  if (run.density == nullptr) return;
  const auto [least, most] = std::ranges::minmax(run.density->values);
  broken.expect("masses", run.size(), run.threads,
                [&, low = least, high = most](std::size_t i) { return wrongMass(run, low, high, i); });
  if (run.detail != Detail::measures) {
    broken.expect("masses", run.size(), run.threads, [&](std::size_t i) { return wrongCenter(run, i); });
  }
  const auto& mass = run.diagram.mass;
  const double sum = std::accumulate(mass.begin(), mass.end(), 0.0), whole = massOf(run);
  if (!std::isfinite(whole)) return;
  // Copies of an edge a period apart may have been rounded apart.
  const double apart = run.repeats() ? 64 * epsilon * run.largest * static_cast<double>(run.size()) : 0;
  const Box& box = run.caller_domain;
  const double slack = mass_slack * whole + apart * most * (box.xmax - box.xmin) * (box.ymax - box.ymin);
  const bool right = run.outline != nullptr ? sum <= whole + slack : std::abs(sum - whole) <= slack;
  if (!right) broken.add("masses", fmt::format("they add up to {}, the density to {}", sum, whole));
}

}  // namespace vorpipe::core::checks
