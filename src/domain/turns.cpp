#include "domain/turns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "domain/degrees.h"

namespace vorpipe::core {
namespace {

/// The whole turns, in degrees, that bring a longitude next to another one.
double turnsTo(double longitude, double other) {
  return whole_turn * std::round((other - longitude) / whole_turn);
}

/// Number of edges that cross the meridian opposite to the center.
std::size_t jumpsOf(std::span<const Point> ring) {
  std::size_t jumps = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point &a = ring[k], &b = ring[k + 1 < ring.size() ? k + 1 : 0];
    jumps += std::abs(b.x - a.x) > whole_turn / 2 ? 1u : 0u;
  }
  return jumps;
}

struct Longitudes {
  double least, most;
  [[nodiscard]] double middle() const { return least + (most - least) / 2; }
};

Longitudes longitudesOf(std::span<const Point> ring) {
  const auto [least, most] = std::ranges::minmax(ring, {}, &Point::x);
  return {least.x, most.x};
}

void turn(std::span<Point> points, double degrees) {
  for (Point& point : points) point.x += degrees;
}

}  // namespace

void joinTurns(double site, std::size_t cell, Diagram& diagram) {
  const CellRings rings = diagram.cell(cell).rings();
  std::optional<double> place;  ///< longitude of the cell, once known
  bool joined = false;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::size_t jumps = jumpsOf(rings[r]);
    if (jumps == 0 || jumps % 2 == 1) continue;
    const auto ring = std::span(diagram.vertices).subspan(rings.begin(r), rings[r].size());
    for (std::size_t k = 1; k < ring.size(); ++k) ring[k].x += turnsTo(ring[k].x, ring[k - 1].x);
    joined = true;
    const auto [least, most] = longitudesOf(ring);
    const double near = site + turnsTo(site, (least + most) / 2);
    const bool holds_site = near >= least && near <= most;
    if (!place && holds_site) place = site;
  }
  if (!joined) return;
  const std::uint64_t begin = diagram.cell_offsets[cell];
  const auto all = std::span(diagram.vertices).subspan(begin, diagram.cell_offsets[cell + 1] - begin);
  if (!place) place = longitudesOf(all).middle();
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const auto ring = std::span(diagram.vertices).subspan(rings.begin(r), rings[r].size());
    if (jumpsOf(ring) == 0) turn(ring, turnsTo(longitudesOf(ring).middle(), *place));
  }
  const double middle = longitudesOf(all).middle();
  diagram.centroid[cell].x += turnsTo(diagram.centroid[cell].x, middle);
  if (!diagram.mass_centroid.empty()) {
    diagram.mass_centroid[cell].x += turnsTo(diagram.mass_centroid[cell].x, middle);
  }
}

}  // namespace vorpipe::core
