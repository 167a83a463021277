/// Whether a point lies in a box.
#pragma once

#include "vorpipe.h"

namespace vorpipe {

/// True on the walls; false for NaN.
inline bool isInside(const Box& box, double x, double y) {
  return x >= box.xmin && x <= box.xmax && y >= box.ymin && y <= box.ymax;
}

}  // namespace vorpipe
