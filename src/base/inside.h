/// Whether places lie in a box.
#pragma once

#include "vorpipe.h"

namespace vorpipe {

/// Its walls belong to it. False of what is not a number.
inline bool isInside(const Box& box, double x, double y) {
  return x >= box.xmin && x <= box.xmax && y >= box.ymin && y <= box.ymax;
}

}  // namespace vorpipe
