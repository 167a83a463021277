#include "space/cell_walk.h"

namespace vorpipe::space {

std::uint32_t CellWalk::nameOf(std::uint32_t became) {
  constexpr std::uint32_t scatter = 2654435769U;
  for (std::uint32_t slot = became * scatter >> 8 & mask_;; slot = (slot + 1) & mask_) {
    const std::uint32_t name = table_[slot];
    if (name >= became_.size() || slot_[name] != slot) {
      const auto next = static_cast<std::uint32_t>(became_.size());
      table_[slot] = next;
      slot_[next] = slot;
      became_.push_back(became);
      return next;
    }
    if (became_[name] == became) return name;
  }
}

std::vector<RingStep>& CellWalk::walk(const Row& row, std::size_t face, std::size_t k) {
  const std::size_t begin = row.ringBegin(face), n = row.ringBegin(face + 1) - begin;
  steps_.resize(n + 1);
  std::size_t count = 0;
  std::uint32_t last = no_name;
  const auto go = [&](std::size_t end) {
    const std::uint32_t to = at_end_[end];
    const bool is_step = to != last && to != no_name;
    steps_[count] = {static_cast<std::uint32_t>(end), to};
    count += is_step ? 1 : 0;
    last = is_step ? to : last;
  };
  for (std::size_t end = begin + k; end < begin + n; ++end) go(end);
  for (std::size_t end = begin; end < begin + k; ++end) go(end);
  steps_.resize(count);
  if (count > 1 && steps_.back().to == steps_.front().to) steps_.erase(steps_.begin());
  if (steps_.size() == 1) steps_.clear();
  return steps_;
}

}  // namespace vorpipe::space
