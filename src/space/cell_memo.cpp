#include "space/cell_memo.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/double_double.h"
#include "space/relative.h"

namespace vorpipe::space {
namespace {

std::uint64_t mixed(std::uint64_t bits) {
  bits *= 0x9e3779b97f4a7c15ULL;
  return bits ^ bits >> 29U;
}

}  // namespace

void ExactRow::set(std::span<const std::array<Label, 3>> corners) {
  neighbors.clear();
  vertices.clear();
  for (const auto& corner : corners) neighbors.insert(neighbors.end(), corner.begin(), corner.end());
  std::ranges::sort(neighbors);
  neighbors.erase(std::ranges::unique(neighbors).begin(), neighbors.end());
  for (const auto& corner : corners) {
    std::array<std::uint32_t, 3> faces{};
    for (std::size_t e = 0; e < 3; ++e) {
      faces[e] =
          static_cast<std::uint32_t>(std::ranges::lower_bound(neighbors, corner[e]) - neighbors.begin());
    }
    vertices.push_back(faces);
  }
}

/// Finds the sites within reach, and the walls within half of it: no point of the cell is farther. Returns
/// false if there are too many.
bool CellMemo::lookAround(Label site) {
  from_ = bins_.sites[static_cast<std::size_t>(site)];
  around_.clear();
  key_ = 0;
  for (int wall = 0; wall < walls; ++wall) {
    const Label label = labelOfWall(wall);
    const double distance = difference(label).x;
    if (distance > 0 && 4 * distance * distance > squared_reach_ * (1 + 1e-9)) continue;
    const std::uint64_t key =
        mixed(std::bit_cast<std::uint64_t>(distance) + static_cast<std::uint64_t>(wall));
    around_.push_back({key, label});
    key_ += key;
  }
  // What is near by its rounded distance is in these bins: more than rounding can take is added.
  const double reach = std::sqrt(squared_reach_) * (1 + 1e-9);
  const auto margin = [reach](double at) { return reach + 0x1p-50 * std::abs(at); };
  const double x = margin(from_.x), y = margin(from_.y), z = margin(from_.z);
  const auto low = bins_.binOf({from_.x - x, from_.y - y, from_.z - z});
  const auto high = bins_.binOf({from_.x + x, from_.y + y, from_.z + z});
  for (int bin_z = low[2]; bin_z <= high[2]; ++bin_z) {
    for (int bin_y = low[1]; bin_y <= high[1]; ++bin_y) {
      const std::size_t line = (static_cast<std::size_t>(bin_z) * static_cast<std::size_t>(bins_.count[1]) +
                                static_cast<std::size_t>(bin_y)) *
                               static_cast<std::size_t>(bins_.count[0]);
      const std::uint32_t last = bins_.begin[line + static_cast<std::size_t>(high[0]) + 1];
      for (std::uint32_t j = bins_.begin[line + static_cast<std::size_t>(low[0])]; j < last; ++j) {
        const Point3& p = bins_.sites[j];
        const double dx = p.x - from_.x, dy = p.y - from_.y, dz = p.z - from_.z;
        if (!(dx * dx + dy * dy + dz * dz <= squared_reach_) || static_cast<Label>(j) == site) continue;
        const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
        const std::uint64_t key = mixed(mixed(mixed(bits(dx)) + bits(dy)) + bits(dz));
        around_.push_back({key, static_cast<Label>(j)});
        key_ += key;
      }
      if (around_.size() > most_around) {
        squared_reach_ = 0;
        return false;
      }
    }
  }
  std::sort(around_.begin(), around_.end(),
            [](const Neighbor& a, const Neighbor& b) { return a.key < b.key; });
  return true;
}

/// Of a wall its distance; what stands beside is of no site.
CellMemo::Difference CellMemo::difference(Label to) const {
  if (isWallLabel(to)) {
    const int wall = wallOf(to);
    const double at = coordinate(from_, axisOf(wall)), offset = bins_.places().offset(wall);
    const auto out = isUpper(wall) ? DoubleDouble::sum(offset, -at) : DoubleDouble::sum(at, -offset);
    return {out.high, static_cast<double>(wall), HUGE_VAL, out.low, 0, 0};
  }
  const Point3& p = bins_.sites[static_cast<std::size_t>(to)];
  const auto x = DoubleDouble::sum(p.x, -from_.x), y = DoubleDouble::sum(p.y, -from_.y),
             z = DoubleDouble::sum(p.z, -from_.z);
  return {x.high, y.high, z.high, x.low, y.low, z.low};
}

bool CellMemo::isSame(const Known& known) const {
  if (known.key != key_ || known.around.size() != around_.size() || known.squared_reach > squared_reach_ ||
      known.around.empty()) {
    return false;
  }
  bool same = true;
  for (std::size_t k = 0; k < around_.size() && same; ++k)
    same = known.around[k] == difference(around_[k].site);
  return same;
}

bool CellMemo::find(Label site, ExactRow& row) {
  constexpr std::uint32_t first_asked = 1024, least_part = 4;
  usable_ = squared_reach_ > 0 && (asked_ < first_asked || found_ > asked_ / least_part) && lookAround(site);
  if (!usable_) return false;
  ++asked_;
  const Known& known = table_[(key_ >> 32U) % table_size];
  if (!isSame(known)) return false;
  ++found_;
  write(known, row);
  return true;
}

void CellMemo::write(const Known& known, ExactRow& row) {
  by_label_.clear();
  for (std::uint32_t f = 0; f < known.faces.size(); ++f)
    by_label_.emplace_back(around_[known.faces[f]].site, f);
  std::sort(by_label_.begin(), by_label_.end());
  std::array<std::uint8_t, most_around> rank{};
  row.neighbors.clear();
  for (const auto& [label, f] : by_label_) {
    rank[f] = static_cast<std::uint8_t>(row.neighbors.size());
    row.neighbors.push_back(label);
  }
  row.vertices.clear();
  for (const auto& v : known.vertices) row.vertices.push_back({rank[v[0]], rank[v[1]], rank[v[2]]});
}

void CellMemo::keep(const ExactRow& row, double squared_reach) {
  if (!usable_ || squared_reach > squared_reach_) {
    // A bit more, so that it does not depend on rounding which sites of a lattice are in reach.
    if (std::ranges::none_of(row.neighbors, isWallLabel))
      squared_reach_ = std::max(squared_reach_, squared_reach * 1.03);
    return;
  }
  Known& known = table_[(key_ >> 32U) % table_size];
  known.key = 0;
  known.around.clear();
  known.faces.clear();
  known.vertices.clear();
  for (const Label label : row.neighbors) {
    const auto at = std::ranges::find(around_, label, &Neighbor::site);
    if (at == around_.end()) return;
    known.faces.push_back(static_cast<std::uint8_t>(at - around_.begin()));
  }
  for (const Neighbor& neighbor : around_) known.around.push_back(difference(neighbor.site));
  for (const auto& v : row.vertices) {
    known.vertices.push_back(
        {static_cast<std::uint8_t>(v[0]), static_cast<std::uint8_t>(v[1]), static_cast<std::uint8_t>(v[2])});
  }
  known.key = key_;
  known.squared_reach = squared_reach;
}

}  // namespace vorpipe::space
