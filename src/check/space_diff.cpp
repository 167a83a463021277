#include <fmt/core.h>

#include <algorithm>

#include "base/refusal.h"
#include "vorpipe.h"

namespace vorpipe {

Result<Cells3Diff> diffCells(const Diagram3& a, const Diagram3& b) {
  if (a.size() != b.size()) {
    return tl::unexpected(
        refusalOf(Subject::sites, fmt::format("the diagrams have {} and {} of them", a.size(), b.size())));
  }
  const auto cells = static_cast<double>(std::ranges::count(a.status, Status::ok));
  const double slack = cells > 0 ? area_slack_of_mean * volumeSum(a) / cells : 0;
  const bool shifts = !a.neighbor_shifts.empty() && !b.neighbor_shifts.empty();
  const auto neighborsOf = [shifts](const Diagram3& diagram, std::size_t i) {
    std::vector<std::pair<std::int64_t, std::array<std::int32_t, 3>>> list;
    for (std::uint64_t f = diagram.face_offsets[i]; f < diagram.face_offsets[i + 1]; ++f)
      list.emplace_back(diagram.neighbors[f],
                        shifts ? diagram.neighbor_shifts[f] : std::array<std::int32_t, 3>{});
    std::ranges::sort(list);
    return list;
  };
  constexpr std::size_t kept = 10;
  Cells3Diff diff;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool status = a.status[i] != b.status[i] || a.owner[i] != b.owner[i];
    const bool neighbors = neighborsOf(a, i) != neighborsOf(b, i);
    const double difference = std::abs(a.volume[i] - b.volume[i]);
    // NaN differs from everything.
    const bool volume = !(difference <= area_slack_of_cell * std::max(a.volume[i], b.volume[i]) + slack);
    diff.statuses += status ? 1u : 0u;
    diff.neighbors += neighbors ? 1u : 0u;
    diff.volumes += volume ? 1u : 0u;
    if (!status && !neighbors && !volume) {
      ++diff.equal;
    } else if (diff.first.size() < kept) {
      diff.first.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return diff;
}

}  // namespace vorpipe
