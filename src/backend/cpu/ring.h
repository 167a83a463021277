/// The edges of a cell in order, and whether a given precision determines them well enough.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "backend/cpu/glsl.h"
#include "backend/tie.h"

namespace vorpipe::cpu {

/// An edge of a cell, as in struct Cell of cell.glsl.
template <class Real>
struct RingEdge {
  std::int32_t line;  ///< a site, or a wall
  Real nx, ny, h, lo, hi;
  Real angle;  ///< of the normal, by pseudoAngle
  Real moved;  ///< how far the difference of weights moves the line, in either direction
  Real apart;  ///< the distance between the sites, or between a site and its image behind a wall
};

/// A vector of the plane.
template <class Real>
struct Vector {
  Real x{}, y{};
};

/// Another site, as seen from the cell's own.
template <class Real>
struct Offset {
  Real x, y;
  Real weight_difference;  ///< the weight of the cell's own site minus the other's
};

/// A fraction of tieScale, like shortest_edge. A site that was left out surely has no edge if that would be
/// no longer than this.
constexpr double no_edge = 5e-7;
/// Lengths with less uncertainty than this are accepted to tell an edge from a tie.
constexpr double unsure_edge = 5e-8;

/// Bounds how far rounding may have moved the intersection of two lines; `turn` is the sine of their angle.
/// near: the sum of the lines' heights, of how far weights moved them, and of the site's distance from the
/// origin; far: the point's distance from the origin. With u the unit of rounding, a normal is off by 2 u in
/// direction and 5 u in length, a height by 3 u, sine and cosine by 6 u. So the place on a line, (h - h_k
/// cosine) / sine, is off by at most (24 near + 8 far) u / sine.
template <class Real>
Real cornerNoise(Real near, Real far, Real turn) {
  using real = Real;
  const Real u = Real(ROUNDING);
  const Real rounding = u * (Real(24.0) * near + Real(8.0) * far);
  return turn > Real(8.0) * u ? rounding / turn : near + far;
}

template <class Real>
void sortRing(std::vector<RingEdge<Real>>& ring) {
  std::sort(ring.begin(), ring.end(), [](const auto& a, const auto& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.line < b.line;
  });
}

/// Returns the end point of an edge.
template <class Real>
Vector<Real> endOf(const RingEdge<Real>& edge) {
  return {edge.nx * edge.h - edge.ny * edge.hi, edge.ny * edge.h + edge.nx * edge.hi};
}

/// Bounds how far rounding may have moved the corner between an edge and the next.
template <class Real>
Real noiseBetween(const RingEdge<Real>& a, const RingEdge<Real>& b, const Vector<Real>& origin_offset) {
  const auto corner = endOf(a);
  const Real near = abs(a.h) + a.moved + abs(b.h) + b.moved + abs(origin_offset.x) + abs(origin_offset.y);
  return cornerNoise<Real>(near, abs(corner.x) + abs(corner.y), a.nx * b.ny - a.ny * b.nx);
}

/// Whether the sorted ring is no wider than the uncertainty of its corners: then it may be empty.
template <class Real>
bool mayBeEmpty(const std::vector<RingEdge<Real>>& ring, const Vector<Real>& origin_offset) {
  const auto count = ring.size();
  for (const auto& edge : ring) {
    bool is_thin = true;
    for (std::size_t k = 0; k < count && is_thin; ++k) {
      const auto corner = endOf(ring[k]);
      const Real inside = edge.h - (corner.x * edge.nx + corner.y * edge.ny);
      is_thin = inside <= Real(2.0) * noiseBetween(ring[k], ring[(k + 1) % count], origin_offset);
    }
    if (is_thin) return true;
  }
  return false;
}

/// Whether the sorted edges go around once and every length is precise enough to tell an edge from a tie.
/// blur bounds what else may have shortened an edge; shorter_side is the domain's.
template <class Real>
bool isSure(const std::vector<RingEdge<Real>>& ring, const Vector<Real>& origin_offset, Real blur,
            double shorter_side) {
  const auto count = ring.size();
  const auto cornerAfter = [&](std::size_t k) {
    const auto& a = ring[k];
    const auto& b = ring[(k + 1) % count];
    const auto corner = endOf(a);
    const Real noise = noiseBetween(a, b, origin_offset);
    const Real gap_x = b.nx * b.h - b.ny * b.lo - corner.x;
    const Real gap_y = b.ny * b.h + b.nx * b.lo - corner.y;
    return std::pair{noise, abs(gap_x) + abs(gap_y) <= Real(4.0) * noise};
  };
  auto before = cornerAfter(count - 1).first;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& edge = ring[k];
    const auto [after, closed] = cornerAfter(k);
    const Real scale = tieScale(edge.apart, shorter_side);
    const Real unsure = before + after + blur;
    const Real length = edge.hi - edge.lo;
    const bool is_edge = length - unsure > Real(shortest_edge) * scale;
    const bool is_tie = length + unsure < Real(shortest_edge) * scale;
    if (!closed || (!is_edge && !is_tie && unsure >= Real(unsure_edge) * scale)) return false;
    before = after;
  }
  return count >= 3;
}

}  // namespace vorpipe::cpu
