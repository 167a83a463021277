#include <algorithm>
#include <iterator>
#include <utility>

#include "vorpipe.h"

namespace vorpipe {

/// Returns the smallest free piece that is large enough, else the end, as glibc does with large pieces.
std::uint64_t MemoryPlan::place(std::uint64_t bytes) {
  auto best = free_.end();
  for (auto piece = free_.begin(); piece != free_.end(); ++piece) {
    const auto size = piece->second - piece->first;
    if (size >= bytes && (best == free_.end() || size < best->second - best->first)) best = piece;
  }
  if (best == free_.end()) {
    // A free piece at the end grows.
    const auto last = free_.empty() ? free_.end() : std::prev(free_.end());
    const bool grows = last != free_.end() && last->second == top_;
    const auto begin = grows ? last->first : top_;
    if (grows) free_.erase(last);
    top_ = begin + bytes;
    return begin;
  }
  const auto [begin, end] = *best;
  free_.erase(best);
  if (end > begin + bytes) free_[begin + bytes] = end;
  return begin;
}

/// Returns the number of these bytes never written before.
std::uint64_t MemoryPlan::touch(std::uint64_t begin, std::uint64_t end) {
  if (begin == end) return 0;
  std::uint64_t known = 0, low = begin, high = end;
  auto piece = touched_.upper_bound(begin);
  if (piece != touched_.begin() && std::prev(piece)->second >= begin) --piece;
  while (piece != touched_.end() && piece->first <= end) {
    known +=
        std::min(piece->second, end) - std::min(std::max(piece->first, begin), std::min(piece->second, end));
    low = std::min(low, piece->first);
    high = std::max(high, piece->second);
    piece = touched_.erase(piece);
  }
  touched_[low] = high;
  return end - begin - known;
}

MemoryPlan::Array MemoryPlan::take(std::string_view what, std::uint64_t bytes, std::uint64_t written) {
  const auto begin = place(bytes);
  blocks_.push_back({std::string(what), begin, bytes, std::min(written, bytes), true});
  const auto fresh = touch(begin, begin + blocks_.back().written);
  touched_bytes_ += fresh;
  if (fresh > 0) noteParts();
  return blocks_.size() - 1;
}

void MemoryPlan::drop(Array array) {
  Block& block = blocks_[array];
  if (!std::exchange(block.live, false) || block.bytes == 0) return;
  auto begin = block.begin, end = block.begin + block.bytes;
  auto after = free_.lower_bound(begin);
  if (after != free_.end() && after->first == end) {
    end = after->second;
    after = free_.erase(after);
  }
  if (after != free_.begin() && std::prev(after)->second == begin) {
    begin = std::prev(after)->first;
    free_.erase(std::prev(after));
  }
  free_[begin] = end;
}

void MemoryPlan::drop(const std::vector<Array>& arrays) {
  for (const auto array : arrays) drop(array);
}

void MemoryPlan::dropSince(Array first, const std::vector<Array>& kept) {
  for (auto array = first; array < blocks_.size(); ++array) {
    if (std::ranges::find(kept, array) == kept.end()) drop(array);
  }
}

void MemoryPlan::noteParts() {
  std::map<std::string, std::uint64_t> sums;
  std::uint64_t live = 0;
  for (const Block& block : blocks_) {
    if (!block.live || block.written == 0) continue;
    sums[block.what] += block.written;
    live += block.written;
  }
  if (touched_bytes_ > live) sums["kept of what was freed"] = touched_bytes_ - live;
  parts_.clear();
  for (auto& [what, bytes] : sums) parts_.push_back({what, bytes});
  std::ranges::stable_sort(parts_, std::greater<>(), &MemoryPart::bytes);
}

}  // namespace vorpipe
