/// A density for what moves sites.
#pragma once

#include <cmath>

#include "vorpipe.h"

namespace vorpipe::test {

/// A bright blob on darker ground.
inline Density blob(int side, double ground) {
  Density density{side, side, {}};
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double x = (column + 0.5) / side - 0.4, y = (row + 0.5) / side - 0.6;
      density.values.push_back(std::exp(-8 * (x * x + y * y)) + ground);
    }
  }
  return density;
}

}  // namespace vorpipe::test
