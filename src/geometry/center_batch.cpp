#include "geometry/center_batch.h"

#include "base/processors.h"
#include "geometry/power_center.h"

namespace vorpipe::core {

void CenterBatch::add(std::size_t corner, const Triple& triple) {
  corner_[size_] = corner;
  i_.set(size_, triple.i);
  j_.set(size_, triple.j);
  k_.set(size_, triple.k);
  ++size_;
}

FOR_WIDE_TOO void CenterBatch::place() {
  for (std::size_t n = 0; n < size_; ++n) {
    const AnchoredPoint center = wideCenterOf(i_.at(n), j_.at(n), k_.at(n));
    base_x_[n] = center.base.x;
    base_y_[n] = center.base.y;
    rest_x_[n] = center.rest.x;
    rest_y_[n] = center.rest.y;
  }
}

}  // namespace vorpipe::core
