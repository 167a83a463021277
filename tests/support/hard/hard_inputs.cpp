#include "support/hard/hard_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "support/hard/hard_domains.h"
#include "support/hard/hard_shapes.h"
#include "support/hard/hard_weights.h"
#include "support/sites/data_sets.h"

namespace vorpipe::test {
namespace {

/// A seed that differs in all bits from that of the next number (the finalizer of SplitMix64).
std::uint64_t mixed(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t z = seed + 0x9E3779B97F4A7C15u * (number + 1);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// Mostly a few: what fails with many mostly fails with few as well.
std::uint64_t countOfSites(Random& random) {
  const auto which = random.below(100);
  if (which < 45) return 1 + random.below(12);
  if (which < 80) return 13 + random.below(108);
  if (which < 98) return 121 + random.below(280);
  return 1000 + random.below(3000);
}

/// Sites of one shape, sometimes small and elsewhere, so that shapes do not lie upon each other.
void addShape(std::uint64_t n, bool moved, HardInput& input, Random& random) {
  const auto shapes = hardShapes();
  const HardShape& shape = shapes[random.below(shapes.size())];
  auto sites = shape.make(n, random);
  if (moved) {
    const double scale = tenTo(random, -6, 0);
    const double x = random.uniform(), y = random.uniform();
    for (double& value : sites.x) value = x + scale * value;
    for (double& value : sites.y) value = y + scale * value;
  }
  append(input.sites, sites);
  input.kinds += (input.kinds.empty() ? "" : "+") + std::string(shape.name);
}

void addDuplicates(HardInput& input, Random& random) {
  const auto before = input.sites.size();
  for (std::uint64_t k = 1 + random.below(3 + before / 10); k > 0; --k) {
    const auto i = random.below(before);
    add(input.sites, {input.sites.x[i], input.sites.y[i]});
  }
  input.kinds += "+duplicates";
}

/// Sites beyond the others, as far away as doubles reach without effort.
void addFar(HardInput& input, Random& random) {
  for (std::uint64_t k = 1 + random.below(3); k > 0; --k) {
    const double away = tenTo(random, 1, 14);
    const Point d = direction(random);
    add(input.sites, {away * d.x, away * d.y});
  }
  input.kinds += "+far";
}

void takeDataSet(std::uint64_t n, HardInput& input, Random& random) {
  const auto& kinds = onceIn(random, 2) ? dataSetKinds() : weightedSetKinds();
  const auto& kind = kinds[random.below(kinds.size())];
  auto set = makeDataSet(kind.name, std::max<std::uint64_t>(n, 4), random());
  input.sites = std::move(set.sites);
  input.domain = set.domain;
  input.kinds = kind.name;
}

void makeSites(std::uint64_t n, HardInput& input, Random& random) {
  const auto which = random.below(20);
  const std::uint64_t shapes = which < 12 ? 1 : which < 17 ? 2 : 3;
  const bool moved = shapes > 1 && onceIn(random, 2);
  for (std::uint64_t k = 0; k < shapes; ++k)
    addShape(std::max<std::uint64_t>(n / shapes, 1), moved, input, random);
  if (onceIn(random, 7)) addDuplicates(input, random);
  if (onceIn(random, 12)) addFar(input, random);
}

Box boxOf(const Sites& sites) {
  const auto [xmin, xmax] = std::ranges::minmax(sites.x);
  const auto [ymin, ymax] = std::ranges::minmax(sites.y);
  return {xmin, ymin, xmax, ymax};
}

bool isValid(const Box& box) {
  return box.xmin < box.xmax && box.ymin < box.ymax && std::isfinite(box.xmax - box.xmin) &&
         std::isfinite(box.ymax - box.ymin);
}

void makeWeights(HardInput& input, Random& random) {
  const auto kinds = hardWeights();
  const HardWeights& kind = kinds[random.below(kinds.size())];
  const Box box = boxOf(input.sites);
  const double extent = std::max({box.xmax - box.xmin, box.ymax - box.ymin, 1e-300});
  input.sites.weight = kind.make(input.sites, std::min(extent, 16.0), random);
  input.kinds += fmt::format(", {} weights", kind.name);
}

void makeDomain(HardInput& input, Random& random) {
  Box around = boxOf(input.sites);
  if (!isValid(around)) around = boxOfFile(input.sites);
  const auto domains = hardDomains();
  const HardDomain& domain = domains[random.below(domains.size())];
  input.domain = domain.make(input.sites, around, random);
  if (isValid(input.domain)) {
    input.kinds += fmt::format(", {} domain", domain.name);
  } else {
    input.domain = boxOfFile(input.sites);
  }
}

/// Everything larger or smaller, or far from the origin.
void moveAll(HardInput& input, Random& random) {
  double scale = 1, x = 0, y = 0;
  switch (random.below(8)) {
    case 0:
      scale = std::ldexp(1.0, static_cast<int>(random.below(81)) - 40);
      break;
    case 1:
      scale = std::pow(10.0, static_cast<double>(random.below(201)) - 100);
      break;
    case 2:
      x = std::round(tenTo(random, 3, 12));
      y = oneOf(random, {0.0, -x, std::round(tenTo(random, 3, 12))});
      break;
    default:
      return;
  }
  auto moved = input;
  for (double& value : moved.sites.x) value = x + scale * value;
  for (double& value : moved.sites.y) value = y + scale * value;
  for (double& value : moved.sites.weight) value *= scale * scale;
  moved.domain = {x + scale * input.domain.xmin, y + scale * input.domain.ymin, x + scale * input.domain.xmax,
                  y + scale * input.domain.ymax};
  if (!isValid(moved.domain)) return;
  moved.kinds += scale != 1 ? fmt::format(", times {:.3g}", scale) : fmt::format(", from {},{}", x, y);
  input = std::move(moved);
}

void makePeriodic(HardInput& input, Random& random) {
  input.periodic = oneOf(random, {Periodic::x, Periodic::y, Periodic::xy, Periodic::xy});
}

/// Has some sites, and some that stand in corners of the outline, mirrored at one of its sides: bisectors
/// then lie in sides.
void addTwins(HardInput& input, Random& random) {
  const auto& [points, rings, polygons] = input.outline;
  for (auto n = 1 + random.below(6); n > 0; --n) {
    const auto ring = random.below(rings.size() - 1), size = rings[ring + 1] - rings[ring],
               k = random.below(size);
    const Point a = points[rings[ring] + k], b = points[rings[ring] + (k + 1) % size];
    const auto i = random.below(input.sites.size());
    const Point p =
        onceIn(random, 2) ? points[random.below(points.size())] : Point{input.sites.x[i], input.sites.y[i]};
    const Point way{b.x - a.x, b.y - a.y}, to{p.x - a.x, p.y - a.y};
    const double twice = 2 * (to.x * way.x + to.y * way.y) / (way.x * way.x + way.y * way.y);
    const Point twin{way.x == 0 ? 2 * a.x - p.x : a.x + twice * way.x - to.x,
                     way.y == 0 ? 2 * a.y - p.y : a.y + twice * way.y - to.y};
    if (!std::isfinite(twin.x) || !std::isfinite(twin.y)) continue;
    for (const Point q : {p, twin}) {
      add(input.sites, q);
      if (!input.sites.weight.empty()) input.sites.weight.push_back(input.sites.weight[i]);
    }
  }
  input.kinds += ", twins at sides";
}

void makeOutline(HardInput& input, Random& random) {
  input.outline = hardOutline(input.sites, input.domain, random);
  input.domain = boxOf(input.outline.points);
  input.kinds += fmt::format(", outline of {} points", input.outline.points.size());
  if (onceIn(random, 3)) addTwins(input, random);
}

int sideOf(Random& random) { return static_cast<int>(std::lround(std::pow(300.0, random.uniform()))); }

std::string_view nameOf(Periodic periodic) {
  constexpr std::array<std::string_view, 4> names{"none", "x", "y", "xy"};
  return names[static_cast<std::size_t>(periodic)];
}

}  // namespace

HardInput makeHardInput(std::uint64_t seed, std::uint64_t number) {
  Random random(mixed(seed, number));
  HardInput input;
  input.seed = seed;
  input.number = number;
  const auto n = countOfSites(random);
  if (onceIn(random, 12)) {
    takeDataSet(n, input, random);
    if (onceIn(random, 2)) makeDomain(input, random);
  } else {
    makeSites(n, input, random);
    if (random.below(20) < 9) makeWeights(input, random);
    makeDomain(input, random);
    moveAll(input, random);
  }
  const auto more = random.below(20);
  if (more < 4) makePeriodic(input, random);
  if (more == 4 || more == 5) makeOutline(input, random);
  if (onceIn(random, 10) && input.sites.weight.empty()) {
    input.search = {Search::flann, oneOf(random, {3, 10, 30})};
  }
  input.width = sideOf(random);
  input.height = sideOf(random);
  return input;
}

std::string describe(const HardInput& input) {
  auto text = fmt::format("--seed {} --case {}: {}; {} site{}", input.seed, input.number, input.kinds,
                          input.sites.size(), input.sites.size() == 1 ? "" : "s");
  if (input.periodic != Periodic::none) text += fmt::format(", periodic {}", nameOf(input.periodic));
  if (input.search.method == Search::flann) text += fmt::format(", flann:{}", input.search.neighbors);
  return text + fmt::format(", {}x{}", input.width, input.height);
}

CellsOptions cellsOptions(const HardInput& input) {
  CellsOptions options{};
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  options.search = input.search;
  return options;
}

RenderOptions pictureOptions(const HardInput& input) {
  RenderOptions options{};
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  options.search = input.search;
  options.width = input.width;
  options.height = input.height;
  return options;
}

}  // namespace vorpipe::test
