#include "space/exact_search.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace vorpipe::space {

void ExactSearch::begin(Label site) {
  site_ = site;
  from_ = bins_.sites[static_cast<std::size_t>(site)];
  const auto bin = bins_.binOf(from_);
  shell_ = last_shell_ = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    bin_[a] = bin[a];
    last_shell_ = std::max({last_shell_, bin[a], bins_.count[a] - 1 - bin[a]});
  }
  certain_ = 0;
  found_.clear();
  next_ = sorted_ = 0;
}

/// The next nearest site whose squared distance is at most `limit`, or -1. Limits do not grow. The bins
/// around are searched in shells of cubes.
Label ExactSearch::next(double limit) {
  while (next_ == sorted_) {
    if (certain_ > limit || shell_ > last_shell_) return -1;
    addShell(limit);
  }
  const Candidate& nearest = found_[next_];
  if (nearest.squared > limit) return -1;
  ++next_;
  return nearest.site;
}

void ExactSearch::addShell(double limit) {
  const int r = shell_++;
  found_.erase(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(next_));
  const int last_x = bins_.count[0] - 1, low = bin_[0] - r, high = bin_[0] + r;
  for (int z = std::max(0, bin_[2] - r); z <= std::min(bins_.count[2] - 1, bin_[2] + r); ++z) {
    for (int y = std::max(0, bin_[1] - r); y <= std::min(bins_.count[1] - 1, bin_[1] + r); ++y) {
      if (r == 0 || std::abs(z - bin_[2]) == r || std::abs(y - bin_[1]) == r) {
        addLine(std::max(0, low), std::min(last_x, high) + 1, y, z, limit);
      } else {
        if (low >= 0) addLine(low, low + 1, y, z, limit);
        if (high <= last_x) addLine(high, high + 1, y, z, limit);
      }
    }
  }
  // A site of a farther shell is at least that many whole bins away; less what rounding takes.
  const double least = static_cast<double>(r) * bins_.side * (1 - 1e-9);
  certain_ = shell_ > last_shell_ ? std::numeric_limits<double>::infinity() : least * least;
  const auto beyond = std::partition(found_.begin(), found_.end(),
                                     [this](const Candidate& c) { return c.squared <= certain_; });
  std::sort(found_.begin(), beyond);
  next_ = 0;
  sorted_ = static_cast<std::size_t>(beyond - found_.begin());
}

/// Sites of neighboring bins along x follow one another.
void ExactSearch::addLine(int x, int end, int y, int z, double limit) {
  const std::size_t line =
      (static_cast<std::size_t>(z) * static_cast<std::size_t>(bins_.count[1]) + static_cast<std::size_t>(y)) *
      static_cast<std::size_t>(bins_.count[0]);
  const std::uint32_t last = bins_.begin[line + static_cast<std::size_t>(end)];
  for (std::uint32_t j = bins_.begin[line + static_cast<std::size_t>(x)]; j < last; ++j) {
    const Point3& p = bins_.sites[j];
    const double dx = p.x - from_.x, dy = p.y - from_.y, dz = p.z - from_.z;
    const double squared = dx * dx + dy * dy + dz * dz;
    if (squared <= limit && static_cast<Label>(j) != site_)
      found_.push_back({squared, static_cast<Label>(j)});
  }
}

/// Sites beyond the root of this cannot cut the cell. Squared distances and radii are rounded.
double ExactSearch::squaredReach() const { return 4 * (1 + 1e-9) * cell_.squaredRadius(); }

/// Begins with the sites around alone. Returns how far away, squared, others may be.
double ExactSearch::takeAround(Label site, std::span<const Label> around, double squared_reach) {
  begin(site);
  shell_ = last_shell_ + 1;
  certain_ = std::numeric_limits<double>::infinity();
  for (const Label label : around) {
    if (isWallLabel(label)) continue;
    const Point3& p = bins_.sites[static_cast<std::size_t>(label)];
    const double dx = p.x - from_.x, dy = p.y - from_.y, dz = p.z - from_.z;
    found_.push_back({dx * dx + dy * dy + dz * dz, label});
  }
  std::sort(found_.begin(), found_.end());
  sorted_ = found_.size();
  return squared_reach;
}

/// Most cells are as large as the one before: candidates that are much farther away are not even collected.
/// If some could cut after all, the cell is cut once more.
const ExactCell& ExactSearch::cellOf(Label site, std::span<const Label> around, double squared_reach) {
  if (bins_.hasWeights()) return weightedCellOf(site);
  constexpr double margin = 2;
  cell_.reset(site);
  double expected = margin * last_reach_;
  if (around.empty()) {
    begin(site);
  } else {
    expected = takeAround(site, around, squared_reach);
  }
  for (;; expected = std::numeric_limits<double>::infinity(), begin(site)) {
    while (!cell_.empty()) {
      const Label by = next(std::min(squaredReach(), expected));
      if (by < 0) break;
      cell_.cut(by);
    }
    if (cell_.empty()) break;
    const double reach = squaredReach();
    if (reach > expected) continue;
    last_reach_ = reach;
    break;
  }
  return cell_;
}

/// As above, by the radius of the cell before.
const ExactCell& ExactSearch::weightedCellOf(Label site) {
  constexpr double margin = 2;
  cell_.reset(site);
  for (double expected = margin * last_reach_;; expected = std::numeric_limits<double>::infinity()) {
    by_power_.begin(site, expected);
    while (!cell_.empty()) {
      const Label by = by_power_.next(std::min(cell_.squaredRadius(), expected));
      if (by < 0) break;
      cell_.cut(by);
    }
    if (cell_.empty()) break;
    if (cell_.squaredRadius() > expected) continue;
    last_reach_ = cell_.squaredRadius();
    break;
  }
  return cell_;
}

const ExactRow& ExactSearch::rowOf(Label site) {
  if (memo_.find(site, row_)) return row_;
  row_.set(cellOf(site, memo_.around(), memo_.squaredReach()).vertices());
  if (!cell_.empty()) memo_.keep(row_, cell_.squaredRadius());
  return row_;
}

}  // namespace vorpipe::space
