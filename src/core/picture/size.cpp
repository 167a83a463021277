#include <algorithm>
#include <cmath>

#include "vorpipe.h"

namespace vorpipe {

PictureSize defaultSize(const Box& domain) {
  constexpr int default_longer_side = 1000;
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  const auto shorter = [](double part) {
    return std::max(1, static_cast<int>(std::lround(part * default_longer_side)));
  };
  if (width >= height) return PictureSize{default_longer_side, shorter(height / width)};
  return PictureSize{shorter(width / height), default_longer_side};
}

}  // namespace vorpipe
