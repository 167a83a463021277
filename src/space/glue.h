/// Rings of two cells that have a face in common.
#pragma once

#include <cstddef>

#include "space/rows.h"

namespace vorpipe::space {

/// Where a face stands in a ring that has it.
inline std::size_t placeIn(const Ring& ring, std::size_t face) {
  std::size_t k = 0;
  while (ring[k] != face) ++k;
  return k;
}

/// Lays the ring of a face of a row on that of the neighbor, which is its reverse. Calls each(a, b, k, at)
/// for each vertex: between the faces a and b of the row, the k-th of its ring and the at-th of the
/// neighbor's. Returns false if the rings are not of the same size, or the first face beside is not in both.
template <class Each>
bool layOn(const Row& row, std::size_t face, const Row& other, std::size_t other_face, const Each& each) {
  const Ring ring = row.ring(face), reverse = other.ring(other_face);
  const std::size_t n = ring.size();
  if (reverse.size() != n) return false;
  // The vertex between ring[k] and ring[k + 1] is that between ring[k + 1] and ring[k] of the other.
  const Label first = row.neighbor[ring[1]];
  std::size_t at = 0;
  while (at < n && other.neighbor[reverse[at]] != first) ++at;
  if (at == n) return false;
  std::size_t a = ring[0];
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t b = ring[k + 1 == n ? 0 : k + 1];
    each(a, b, k, at);
    a = b;
    at = at == 0 ? n - 1 : at - 1;
  }
  return true;
}

}  // namespace vorpipe::space
