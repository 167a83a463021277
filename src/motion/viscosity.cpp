#include "motion/viscosity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/block_sums.h"
#include "motion/linear/conjugate_gradients.h"
#include "motion/linear/mass_change.h"
#include "motion/movable.h"

namespace vorpipe::moving {
namespace {

/// Residual at which velocities are solved, relative to the momenta.
constexpr double friction_tolerance = 1e-11;

/// A site may lie at a wall or beyond it, while the mass of its cell does not. It counts as at least this
/// part of the cell's size away.
constexpr double least_distance = 0.25;

}  // namespace

Friction::Friction(const MovingCells& cells, const Parcels& parcels, const FluidOptions& options, int threads)
    : parcels_(parcels), options_(options), threads_(threads), wall_(parcels.size()) {
  const CellsThatMeet& meet = cells.neighbors();
  const EdgesOfCells& edges = cells.edges();
  massMatrix(meet, edges, threads, between_);
  between_.extra.clear();
  const Box& box = options.domain;
  const Point side{box.xmax - box.xmin, box.ymax - box.ymin};
  const auto stickiness = [&](std::size_t i) {
    return options.viscosity * parcels.mass[i] / parcels.volume[i];
  };
  forAll(parcels.size(), threads, [&](std::size_t i) {
    // The edges of a cell, as vectors along their normals, add up to 0.
    Point outward{0, 0};
    bool has_walls = false;
    for (auto k = meet.offsets[i]; k < meet.offsets[i + 1]; ++k) {
      if (isWall(meet.neighbors[k])) {
        has_walls = true;
        continue;
      }
      const auto j = static_cast<std::size_t>(meet.neighbors[k]);
      Point way{parcels.sites.x[j] - parcels.sites.x[i], parcels.sites.y[j] - parcels.sites.y[i]};
      if (!meet.shifts.empty()) {
        way.x += meet.shifts[k][0] * side.x;
        way.y += meet.shifts[k][1] * side.y;
      }
      outward = shifted(outward, -2 * edges.coupling[k], way);
    }
    for (auto k = between_.offsets[i]; k < between_.offsets[i + 1]; ++k) {
      const double own = stickiness(i), other = stickiness(between_.columns[k]);
      between_.coupling[k] *= 2 * (2 * own * other / (own + other));
    }
    // With a free surface `outward` is of the arcs as well; the fluid slides along walls, and springs keep it
    // from going through.
    if (!has_walls || options.surface == Surface::free) return;
    if (options.outline.empty()) {
      addBoxWalls(i, outward, meet);
    } else {
      addOutline(i, outward, meet, edges);
    }
  });
}

/// Adds the friction of a wall that is as long as `outward`, a normal.
void Friction::addWall(std::size_t i, Point outward, double distance, double spacing) {
  const double length = std::sqrt(product(outward, outward));
  if (!(length > 0)) return;
  const double coupling = options_.viscosity * parcels_.mass[i] / parcels_.volume[i] * length /
                          std::max(distance, least_distance * spacing);
  const Point n{outward.x / length, outward.y / length};
  const bool slides = options_.walls == FluidWalls::slip;
  Tensor& wall = wall_[i];
  wall.xx += coupling * (slides ? n.x * n.x : 1);
  wall.xy += coupling * (slides ? n.x * n.y : 0);
  wall.yy += coupling * (slides ? n.y * n.y : 1);
}

void Friction::addBoxWalls(std::size_t i, Point outward, const CellsThatMeet& meet) {
  const double x = parcels_.sites.x[i], y = parcels_.sites.y[i];
  const double spacing = std::sqrt(parcels_.volume[i]);
  const Box& box = options_.domain;
  bool has_x = false, has_y = false;
  for (auto k = meet.offsets[i]; k < meet.offsets[i + 1]; ++k) {
    has_x = has_x || meet.neighbors[k] == wall_xmin || meet.neighbors[k] == wall_xmax;
    has_y = has_y || meet.neighbors[k] == wall_ymin || meet.neighbors[k] == wall_ymax;
  }
  if (has_x) addWall(i, {outward.x, 0}, outward.x > 0 ? box.xmax - x : x - box.xmin, spacing);
  if (has_y) addWall(i, {0, outward.y}, outward.y > 0 ? box.ymax - y : y - box.ymin, spacing);
}

/// Takes all of the outline along a cell as one wall.
void Friction::addOutline(std::size_t i, Point outward, const CellsThatMeet& meet,
                          const EdgesOfCells& edges) {
  const double length = std::sqrt(product(outward, outward));
  double distance = 0;
  std::size_t walls = 0;
  for (auto k = meet.offsets[i]; k < meet.offsets[i + 1]; ++k) {
    if (!isWall(meet.neighbors[k])) continue;
    const Point way{edges.middle[k].x - parcels_.sites.x[i], edges.middle[k].y - parcels_.sites.y[i]};
    distance += product(way, outward) / length;
    ++walls;
  }
  addWall(i, outward, distance / static_cast<double>(walls), std::sqrt(parcels_.volume[i]));
}

/// Returns (K v)_i.
Point Friction::forceAt(const std::vector<Point>& velocity, std::size_t i) const {
  const Point own = velocity[i];
  Point sum = wall_[i].times(own);
  for (auto k = between_.offsets[i]; k < between_.offsets[i + 1]; ++k) {
    const Point other = velocity[between_.columns[k]];
    sum = shifted(sum, between_.coupling[k], {own.x - other.x, own.y - other.y});
  }
  return sum;
}

/// Replaces v by the solution u of (M + time K) u = M v, which has the kinetic energy of v or less.
std::uint64_t Friction::solve(double time, std::vector<Point>& velocity,
                              const std::function<bool()>& continues) const {
  const std::size_t count = velocity.size();
  const auto& mass = parcels_.mass;
  std::vector<Tensor> inverse(count);
  std::vector<Point> rest(count);
  forAll(count, threads_, [&](std::size_t i) {
    double own = mass[i];
    for (auto k = between_.offsets[i]; k < between_.offsets[i + 1]; ++k) own += time * between_.coupling[k];
    const Tensor& wall = wall_[i];
    const double xx = own + time * wall.xx, yy = own + time * wall.yy, xy = time * wall.xy;
    const double determinant = xx * yy - xy * xy;
    inverse[i] = {yy / determinant, -xy / determinant, xx / determinant};
    rest[i] = shifted({0, 0}, -time, forceAt(velocity, i));
  });
  const double least = friction_tolerance * std::sqrt(carefulSum(count, threads_, [&](std::size_t i) {
                         return mass[i] * mass[i] * product(velocity[i], velocity[i]);
                       }));
  const auto multiply = [&](const std::vector<Point>& way, std::vector<Point>& answer) {
    answer.resize(count);
    forAll(count, threads_, [&](std::size_t i) {
      const Point force = forceAt(way, i);
      answer[i] = {mass[i] * way[i].x + time * force.x, mass[i] * way[i].y + time * force.y};
    });
  };
  const auto scale = [&](Point value, std::size_t i) { return inverse[i].times(value); };
  return conjugateGradients(velocity, rest, least, threads_, multiply, scale, continues);
}

std::uint64_t Friction::act(double time, std::vector<Point>& velocity,
                            const std::function<bool()>& continues) const {
  // With S one implicit step of gamma times the time, the result is S ((1 + root) S v - root v).
  constexpr double root = std::numbers::sqrt2, gamma = 1 - 1 / root;
  std::vector<Point> once = velocity;
  std::uint64_t iterations = solve(gamma * time, once, continues);
  forAll(velocity.size(), threads_, [&](std::size_t i) {
    velocity[i] = {(1 + root) * once[i].x - root * velocity[i].x,
                   (1 + root) * once[i].y - root * velocity[i].y};
  });
  iterations += solve(gamma * time, velocity, continues);
  return iterations;
}

}  // namespace vorpipe::moving
