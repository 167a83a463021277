#include "space/weighted_candidates.h"

#include <algorithm>
#include <cmath>

namespace vorpipe::space {
namespace {

/// Whether a site of at least that squared distance d^2 can cut off a point within radius R, if it is lighter
/// than the cell's own site by e: d^2 + e < 2 R d, which is so for no larger d than R + sqrt(R^2 - e). A few
/// roundings of all that are added.
bool canCut(double squared, double lighter, double squared_radius) {
  constexpr double rounding = 0x1p-48;
  const double root = squared_radius - lighter + rounding * (squared_radius + std::abs(lighter));
  if (root < 0) return false;
  const double reach = std::sqrt(squared_radius) + std::sqrt(root);
  return squared <= reach * reach * (1 + rounding);
}

}  // namespace

bool WeightedCandidates::isAfter(const Entry& a, const Entry& b) {
  if (a.power != b.power) return a.power > b.power;
  return a.level != b.level ? a.level > b.level : a.index > b.index;
}

void WeightedCandidates::begin(Label site, double squared_radius) {
  site_ = site;
  from_ = bins_.sites[static_cast<std::size_t>(site)];
  weight_ = bins_.weights[static_cast<std::size_t>(site)];
  at_ = {(from_.x - bins_.corner.x) / bins_.side, (from_.y - bins_.corner.y) / bins_.side,
         (from_.z - bins_.corner.z) / bins_.side};
  heap_.clear();
  pushBlock(bins_.heaviest.levels() - 1, {0, 0, 0}, squared_radius);
}

void WeightedCandidates::push(const Entry& entry) {
  heap_.push_back(entry);
  std::push_heap(heap_.begin(), heap_.end(), isAfter);
}

/// The distance is in whole and part sides of bins, which take roundings of their number: less than 1e-9.
void WeightedCandidates::pushBlock(std::size_t level, const std::array<int, 3>& block,
                                   double squared_radius) {
  const auto& pyramid = bins_.heaviest;
  for (std::size_t a = 0; a < 3; ++a) {
    if (block[a] >= pyramid.count(level)[a]) return;
  }
  const std::size_t index = pyramid.indexOf(level, block);
  const double heaviest = pyramid.at(level, index);
  if (heaviest == HeaviestOfBlocks::none) return;
  const double size = std::ldexp(1.0, static_cast<int>(level));
  double squared = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double low = block[a] * size;
    const double gap = std::max({low - at_[a], at_[a] - (low + size), 0.0});
    const double less = std::max(0.0, gap * (1 - 1e-9) - 1e-9) * bins_.side;
    squared += less * less;
  }
  const double lighter = weight_ - heaviest;
  if (!canCut(squared, lighter, squared_radius)) return;
  push({squared + lighter, squared, lighter, static_cast<std::uint32_t>(index),
        static_cast<std::uint8_t>(level)});
}

void WeightedCandidates::openBlock(const Entry& entry, double squared_radius) {
  if (entry.level > 0) {
    const auto block = bins_.heaviest.blockOf(entry.level, entry.index);
    for (int part = 0; part < 8; ++part) {
      pushBlock(entry.level - std::size_t{1},
                {2 * block[0] + part % 2, 2 * block[1] + part / 2 % 2, 2 * block[2] + part / 4},
                squared_radius);
    }
    return;
  }
  for (std::uint32_t j = bins_.begin[entry.index]; j < bins_.begin[entry.index + 1]; ++j) {
    if (static_cast<Label>(j) == site_) continue;
    const Point3& p = bins_.sites[j];
    const double x = p.x - from_.x, y = p.y - from_.y, z = p.z - from_.z;
    const double squared = (x * x + y * y) + z * z, lighter = weight_ - bins_.weights[j];
    if (canCut(squared, lighter, squared_radius)) push({squared + lighter, squared, lighter, j, site_level});
  }
}

Label WeightedCandidates::next(double squared_radius) {
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), isAfter);
    const Entry entry = heap_.back();
    heap_.pop_back();
    if (!canCut(entry.squared, entry.lighter, squared_radius)) continue;
    if (entry.level == site_level) return static_cast<Label>(entry.index);
    openBlock(entry, squared_radius);
  }
  return -1;
}

}  // namespace vorpipe::space
