#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr std::size_t sites_kept = 10;

/// Compares cells of two diagrams; reuses buffers for lists that must be sorted.
class CellComparison {
 public:
  CellComparison(const Diagram& a, const Diagram& b) : a_(a), b_(b) {
    const auto cells = static_cast<double>(std::ranges::count(a.status, Status::ok));
    slack_ = cells > 0 ? area_slack_of_mean * areaSum(a) / cells : 0;
  }

  CellDifference at(std::size_t i) {
    const double area_a = a_.area[i], area_b = b_.area[i];
    return {static_cast<std::uint32_t>(i), a_.status[i] != b_.status[i] || a_.owner[i] != b_.owner[i],
            !sameNeighbors(i),
            // NaN differs from everything.
            !(partOfAllowed(area_a, area_b) <= 1), area_a, area_b};
  }

  [[nodiscard]] double partOfAllowed(double a, double b) const {
    const double difference = std::abs(a - b);
    return difference == 0 ? 0 : difference / (area_slack_of_cell * std::max(a, b) + slack_);
  }

 private:
  using List = std::span<const std::int64_t>;

  static List neighborsOf(const Diagram& diagram, std::size_t i) {
    const std::uint64_t begin = diagram.cell_offsets[i];
    return List(diagram.neighbors).subspan(begin, diagram.cell_offsets[i + 1] - begin);
  }

  bool sameNeighbors(std::size_t i) {
    const List a = neighborsOf(a_, i), b = neighborsOf(b_, i);
    if (a.size() != b.size()) return false;
    const bool periodic = !a_.neighbor_shifts.empty() || !b_.neighbor_shifts.empty();
    if (!periodic && std::ranges::equal(a, b)) return true;
    sort(a_, i, sorted_a_);
    sort(b_, i, sorted_b_);
    return sorted_a_ == sorted_b_;
  }

  /// A neighbor and the shift of its image.
  using Image = std::pair<std::int64_t, std::array<std::int32_t, 2>>;

  static void sort(const Diagram& diagram, std::size_t i, std::vector<Image>& sorted) {
    sorted.clear();
    for (auto e = diagram.cell_offsets[i]; e < diagram.cell_offsets[i + 1]; ++e) {
      const auto& shifts = diagram.neighbor_shifts;
      sorted.emplace_back(diagram.neighbors[e], shifts.empty() ? std::array<std::int32_t, 2>{} : shifts[e]);
    }
    std::ranges::sort(sorted);
  }

  const Diagram& a_;
  const Diagram& b_;
  double slack_ = 0;  ///< of an area, independent of the cell's own
  std::vector<Image> sorted_a_, sorted_b_;
};

}  // namespace

Result<CellsDiff> diffCells(const Diagram& a, const Diagram& b) {
  if (a.status.size() != b.status.size()) {
    return tl::unexpected(Error{
        ErrorCode::input,
        fmt::format("cells of {} and of {} sites cannot be compared", a.status.size(), b.status.size())});
  }
  CellsDiff diff;
  CellComparison comparison(a, b);
  for (std::size_t i = 0; i < a.status.size(); ++i) {
    const CellDifference site = comparison.at(i);
    const double part = comparison.partOfAllowed(site.area_a, site.area_b);
    if (!(part <= diff.worst_area)) {
      diff.worst_area = part;
      diff.worst_site = site.site;
    }
    diff.statuses += site.status ? 1 : 0;
    diff.neighbors += site.neighbors ? 1 : 0;
    diff.areas += site.area ? 1 : 0;
    if (!site.status && !site.neighbors && !site.area) {
      ++diff.equal;
    } else if (diff.first.size() < sites_kept) {
      diff.first.push_back(site);
    }
  }
  return diff;
}

}  // namespace vorpipe
