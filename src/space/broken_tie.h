/// How ties of predicates.h are broken.
#pragma once

#include <array>
#include <cstddef>

#include "space/label.h"

namespace vorpipe::space {

/// The labels of a tie in the order of their infinitesimals, the largest first, as indices into `other`; 4 is
/// the site itself.
inline std::array<std::size_t, 5> byHeight(const Places& places, Label site,
                                           const std::array<Label, 4>& other) {
  const auto isHigher = [&](Label a, Label b) {
    if (isWallLabel(a)) return !isWallLabel(b) || a > b;
    return !isWallLabel(b) && places.sites[a] < places.sites[b];
  };
  const std::array<Label, 5> label{other[0], other[1], other[2], other[3], site};
  std::array<std::size_t, 5> order{};
  for (std::size_t k = 1; k < 5; ++k) {
    std::size_t to = k;
    for (; to > 0 && isHigher(label[k], label[order[to - 1]]); --to) order[to] = order[to - 1];
    order[to] = k;
  }
  return order;
}

template <class Number>
int signOf(const Number& number) {
  if constexpr (requires { number.sign(); }) {
    return number.sign();
  } else {
    return number > 0 ? 1 : number < 0 ? -1 : 0;
  }
}

/// The sign that the determinant of the rows (d, lift) of four labels has instead of 0. Its cofactors are
/// what an infinitesimal weighs that lowers one lift. Lowering the height of the site itself raises the lifts
/// of all other sites; those of walls do not count by then, since their cofactors are 0.
template <class Cofactor>
int brokenTie(const Places& places, Label site, const std::array<Label, 4>& other,
              const std::array<Cofactor, 4>& cofactor) {
  for (const std::size_t k : byHeight(places, site, other)) {
    int sign = 0;
    if (k < 4) {
      sign = -signOf(cofactor[k]);
    } else {
      const Cofactor sum = cofactor[0] + cofactor[1] + cofactor[2] + cofactor[3];
      sign = signOf(sum);
    }
    if (sign != 0) return sign;
  }
  return 0;  // not if the first three have an orientation, which is the fourth's cofactor
}

}  // namespace vorpipe::space
