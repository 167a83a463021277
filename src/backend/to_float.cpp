#include "backend/to_float.h"

namespace vorpipe {

CellBatch<float> toFloat(const CellBatch<double>& batch) {
  const auto f = [](double value) { return static_cast<float>(value); };
  CellBatch<float> rounded;
  rounded.entries.reserve(batch.entries.size());
  rounded.lines.reserve(batch.lines.size());
  for (const auto& e : batch.entries) {
    rounded.entries.push_back(
        {e.first, e.count, f(e.west), f(e.south), f(e.east), f(e.north), f(e.reach), f(e.origin_offset)});
  }
  for (const auto& l : batch.lines) rounded.lines.push_back({f(l.nx), f(l.ny), f(l.h), f(l.bound)});
  return rounded;
}

}  // namespace vorpipe
