#include "space/cell_memo.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/double_double.h"
#include "base/processors.h"
#include "space/relative.h"

namespace vorpipe::space {
namespace {

std::uint64_t mixed(std::uint64_t bits) {
  bits *= 0x9e3779b97f4a7c15ULL;
  return bits ^ bits >> 29U;
}

/// By number: how many are less.
FOR_WIDE_TOO void countLess(const std::int32_t* numbers, std::size_t count, std::int32_t* less) {
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t with = numbers[k];
    for (std::size_t j = 0; j < count; ++j) less[j] += with < numbers[j] ? 1 : 0;
  }
}

}  // namespace

void ExactRow::set(std::span<const std::array<Label, 3>> corners) {
  constexpr std::size_t few = 64;
  neighbors.clear();
  vertices.clear();
  std::unordered_map<Label, std::uint32_t> faces;  // of cells of many
  const auto faceOf = [&](Label label) {
    if (neighbors.size() <= few) {
      const auto at = std::ranges::find(neighbors, label);
      if (at != neighbors.end()) return static_cast<std::uint32_t>(at - neighbors.begin());
      neighbors.push_back(label);
      return static_cast<std::uint32_t>(neighbors.size() - 1);
    }
    if (faces.empty()) {
      for (std::uint32_t f = 0; f < neighbors.size(); ++f) faces.emplace(neighbors[f], f);
    }
    const auto [at, is_new] = faces.try_emplace(label, static_cast<std::uint32_t>(neighbors.size()));
    if (is_new) neighbors.push_back(label);
    return at->second;
  };
  for (const auto& [a, b, c] : corners) vertices.push_back({faceOf(a), faceOf(b), faceOf(c)});
}

CellMemo::CellMemo(const SiteBins& bins) : bins_(bins) {
  constexpr std::size_t most = std::size_t{1} << 16;
  table_.resize(std::bit_ceil(std::min(bins.sites.size(), most)));
}

/// Asking takes a tenth of the time of an exact cell.
bool CellMemo::isWorthAsking() {
  constexpr std::uint32_t round = 512, least_found = 64, most_passed = 16384;
  if (pass_over_ > 0) {
    --pass_over_;
    return false;
  }
  if (asked_ == round) {
    next_pass_ = found_of_asked_ >= least_found ? 0 : std::min(most_passed, std::max(round, 2 * next_pass_));
    pass_over_ = next_pass_;
    asked_ = found_of_asked_ = 0;
    if (pass_over_ > 0) return false;
  }
  return true;
}

/// Finds the sites within reach, and the walls within half of it: no point of the cell is farther. Returns
/// false if there are too many.
bool CellMemo::lookAround(Label site) {
  const Point3& from = bins_.sites[static_cast<std::size_t>(site)];
  near_.clear();
  near_key_.clear();
  key_ = 0;
  const auto take = [this](std::uint64_t key) {
    near_key_.push_back(static_cast<std::int32_t>(key >> 32U));
    key_ += key;
  };
  // What is near by its rounded distance is in these bins: more than rounding can take is added.
  const double reach = std::sqrt(squared_reach_) * (1 + 1e-9);
  const auto margin = [reach](double at) { return reach + 0x1p-50 * std::abs(at); };
  const double x = margin(from.x), y = margin(from.y), z = margin(from.z);
  const auto low = bins_.binOf({from.x - x, from.y - y, from.z - z});
  const auto high = bins_.binOf({from.x + x, from.y + y, from.z + z});
  const auto away = [&](std::size_t j) {
    const Point3& p = bins_.sites[j];
    return Point3{p.x - from.x, p.y - from.y, p.z - from.z};
  };
  for (int bin_z = low[2]; bin_z <= high[2]; ++bin_z) {
    for (int bin_y = low[1]; bin_y <= high[1]; ++bin_y) {
      const std::size_t line = (static_cast<std::size_t>(bin_z) * static_cast<std::size_t>(bins_.count[1]) +
                                static_cast<std::size_t>(bin_y)) *
                               static_cast<std::size_t>(bins_.count[0]);
      const std::uint32_t first = bins_.begin[line + static_cast<std::size_t>(low[0])],
                          last = bins_.begin[line + static_cast<std::size_t>(high[0]) + 1];
      // Which are within reach cannot be foreseen: no branch.
      std::size_t count = near_.size();
      near_.resize(count + (last - first));
      for (std::uint32_t j = first; j < last; ++j) {
        const Point3 d = away(j);
        near_[count] = static_cast<Label>(j);
        const bool is_near = d.x * d.x + d.y * d.y + d.z * d.z <= squared_reach_;
        count += is_near && static_cast<Label>(j) != site ? 1 : 0;
      }
      near_.resize(count);
      if (count > most_around) {
        squared_reach_ = 0;
        return false;
      }
    }
  }
  for (const Label label : near_) {
    const Point3 d = away(static_cast<std::size_t>(label));
    const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
    std::uint64_t key = mixed(mixed(mixed(bits(d.x)) + bits(d.y)) + bits(d.z));
    if (bins_.hasWeights()) {
      key = mixed(key + bits(bins_.weights[static_cast<std::size_t>(site)] -
                             bins_.weights[static_cast<std::size_t>(label)]));
    }
    take(key);
  }
  for (int wall = 0; wall < walls; ++wall) {
    const Label label = labelOfWall(wall);
    const double distance = difference(site, label).x;
    if (distance > 0 && 4 * distance * distance > squared_reach_ * (1 + 1e-9)) continue;
    near_.push_back(label);
    take(mixed(std::bit_cast<std::uint64_t>(distance) + static_cast<std::uint64_t>(wall)));
  }
  return order();
}

/// Orders them by keys, so that two sites see the same differences in the same order. Returns false if two
/// have one key. They are few: to count for each those before it takes less time than to sort.
bool CellMemo::order() {
  const std::size_t count = near_.size();
  rank_.assign(count, 0);
  countLess(near_key_.data(), count, rank_.data());
  constexpr Label none = std::numeric_limits<Label>::min();
  around_.assign(count, none);
  for (std::size_t k = 0; k < count; ++k) around_[static_cast<std::size_t>(rank_[k])] = near_[k];
  return std::ranges::find(around_, none) == around_.end();
}

/// Of a wall its distance; what stands beside is of no site.
CellMemo::Difference CellMemo::difference(Label from_site, Label to) const {
  const Point3& from = bins_.sites[static_cast<std::size_t>(from_site)];
  if (isWallLabel(to)) {
    const int wall = wallOf(to);
    const double at = coordinate(from, axisOf(wall)), offset = bins_.places().offset(wall);
    const auto out = isUpper(wall) ? DoubleDouble::sum(offset, -at) : DoubleDouble::sum(at, -offset);
    return {out.high, static_cast<double>(wall), HUGE_VAL, out.low, 0, 0, 0, 0};
  }
  const Point3& p = bins_.sites[static_cast<std::size_t>(to)];
  const auto x = DoubleDouble::sum(p.x, -from.x), y = DoubleDouble::sum(p.y, -from.y),
             z = DoubleDouble::sum(p.z, -from.z);
  DoubleDouble lighter;
  if (bins_.hasWeights()) {
    lighter = DoubleDouble::sum(bins_.weights[static_cast<std::size_t>(from_site)],
                                -bins_.weights[static_cast<std::size_t>(to)]);
  }
  return {x.high, y.high, z.high, x.low, y.low, z.low, lighter.high, lighter.low};
}

/// R + root(R^2 + w), w being what the heaviest of all sites is heavier by; all is rounded.
double CellMemo::reachOf(double squared_radius) const {
  constexpr double margin = 1 + 1e-9;
  if (!bins_.hasWeights()) return 4 * margin * squared_radius;
  const double heavier =
      bins_.heaviest.at(bins_.heaviest.levels() - 1, 0) - bins_.weights[static_cast<std::size_t>(site_)];
  const double reach = std::sqrt(squared_radius) + std::sqrt(squared_radius + margin * heavier);
  return margin * reach * reach;
}

bool CellMemo::isSame(const Known& known) const {
  if (known.key != key_ || known.around.size() != around_.size() ||
      reachOf(known.squared_radius) > squared_reach_ || known.around.empty()) {
    return false;
  }
  bool same = true;
  for (std::size_t k = 0; k < around_.size() && same; ++k) {
    const Label mine = around_[k], its = known.around[k];
    same = isWallLabel(mine) == isWallLabel(its) && difference(site_, mine) == difference(known.site, its);
  }
  return same;
}

bool CellMemo::find(Label site, ExactRow& row) {
  site_ = site;
  usable_ = squared_reach_ > 0 && isWorthAsking() && lookAround(site);
  if (!usable_) return false;
  ++asked_;
  const Known& known = placeOf(key_);
  if (!isSame(known)) return false;
  ++found_of_asked_;
  ++found_;
  write(known, row);
  return true;
}

void CellMemo::write(const Known& known, ExactRow& row) const {
  row.neighbors.clear();
  for (const auto face : known.faces) row.neighbors.push_back(around_[face]);
  row.vertices.clear();
  for (const auto& [a, b, c] : known.vertices) row.vertices.push_back({a, b, c});
}

void CellMemo::keep(const ExactRow& row, double squared_radius) {
  const double squared_reach = reachOf(squared_radius);
  if (!usable_ || squared_reach > squared_reach_) {
    // A bit more, so that it does not depend on rounding which sites of a lattice are in reach.
    if (std::ranges::none_of(row.neighbors, isWallLabel))
      squared_reach_ = std::max(squared_reach_, squared_reach * 1.03);
    return;
  }
  Known& known = placeOf(key_);
  known.key = 0;
  known.around.clear();
  known.faces.clear();
  known.vertices.clear();
  for (const Label label : row.neighbors) {
    const auto at = std::ranges::find(around_, label);
    if (at == around_.end()) return;
    known.faces.push_back(static_cast<std::uint8_t>(at - around_.begin()));
  }
  known.around = around_;
  known.site = site_;
  for (const auto& [a, b, c] : row.vertices) {
    known.vertices.push_back(
        {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c)});
  }
  known.key = key_;
  known.squared_radius = squared_radius;
}

}  // namespace vorpipe::space
