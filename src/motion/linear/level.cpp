#include "motion/linear/level.h"

namespace vorpipe::moving {

void findBorder(Level& level) {
  level.border.clear();
  for (std::uint32_t i = 0; i < level.rows(); ++i) {
    if (level.before[i] > level.offsets[i]) level.border.push_back(i);
  }
}

}  // namespace vorpipe::moving
