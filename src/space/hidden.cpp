#include "space/hidden.h"

#include <algorithm>

#include "space/predicates.h"

namespace vorpipe::space {

/// Points p of the first three have n_k . (p - v) <= 0 at their vertex v. By Cramer's rule the fourth's
/// normal is -(l_0 n_0 + l_1 n_1 + l_2 n_2), where l_k are determinants that have one of the three replaced
/// by the fourth, over -det(n_0, n_1, n_2). If none is negative the fourth is not nearer to p than to v.
bool isNearestVertex(const Places& places, Label site, const NoCell& of) {
  const auto [a, b, c, m] = of;
  return orientation(places, site, m, b, c) <= 0 && orientation(places, site, a, m, c) <= 0 &&
         orientation(places, site, a, b, m) <= 0;
}

bool leaveNothing(const Places& places, Label site, const NoCell& of) {
  for (std::size_t k = 0; k < 4; ++k) {
    if (of[k] == site || std::find(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(k), of[k]) !=
                             of.begin() + static_cast<std::ptrdiff_t>(k))
      return false;
  }
  const auto [a, b, c, m] = of;
  return orientation(places, site, a, b, c) > 0 && isNearestVertex(places, site, of) &&
         cuts(places, site, a, b, c, m);
}

}  // namespace vorpipe::space
