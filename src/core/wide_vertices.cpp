#include "core/wide_vertices.h"

#include <algorithm>
#include <atomic>

#include "core/measure.h"
#include "parallel.h"

namespace vorpipe {
namespace {

constexpr std::size_t grain = 1024;
/// As each of two cells sees them: with fewer ties a vertex is not wide.
constexpr std::uint32_t fewest_ties = 6;
/// How many of its longest ties a vertex is wide, from its place. Two sites are no farther from each other
/// than twice as far as from a corner of both: the check's slack, 1e-5 of that, is more than four ties.
constexpr double nearly_wide = 2, wide = 4;

class Measuring {
 public:
  Measuring(const ProposedCells& proposed, const TiedCells& tied, const Fineness& fineness)
      : proposed_(proposed),
        sites_(proposed.sites),
        tied_(tied),
        fineness_(fineness),
        ties_(tied.place.size()) {}

  WideVertices run() {
    forEntries([&](std::size_t k) {
      for (auto c = tied_.first[k]; c < tied_.first[k + 1]; ++c) {
        if (tied_.tie[c] != 0)
          std::atomic_ref(ties_[tied_.vertex[c]]).fetch_add(1, std::memory_order_relaxed);
      }
    });
    if (std::ranges::none_of(ties_, [](std::uint32_t ties) { return ties >= fewest_ties; })) return {};
    longest_.assign(ties_.size(), 0);
    width_.assign(ties_.size(), 0);
    std::vector<Place> corners;
    for (std::size_t k = 0; k < tied_.cell.size(); ++k) measure(k, corners);
    return {cellsAt(nearly_wide), cellsAt(wide)};
  }

 private:
  template <class Work>
  void forEntries(const Work& work) {
    parallelFor(tied_.cell.size(), grain, proposed_.threads, [&](std::size_t begin, std::size_t end) {
      for (auto k = begin; k < end; ++k) work(k);
    });
  }

  [[nodiscard]] bool hasMany(std::uint64_t corner) const {
    return ties_[tied_.vertex[corner]] >= fewest_ties;
  }

  void measure(std::size_t k, std::vector<Place>& corners) {
    const auto first = tied_.first[k], count = tied_.first[k + 1] - first;
    bool any = false;
    for (std::uint64_t e = 0; e < count && !any; ++e) any = hasMany(first + e);
    if (!any) return;
    const auto cell = tied_.cell[k];
    const auto row = proposed_.cells.edges(cell);
    placeCorners(sites_, cell, row, corners);
    for (std::size_t e = 0; e < row.size(); ++e) {
      if (!hasMany(first + e)) continue;
      const auto vertex = tied_.vertex[first + e];
      width_[vertex] = std::max(width_[vertex], lengthOf(wayBetween(tied_.place[vertex], corners[e])));
      if (tied_.tie[first + e] == 0) continue;
      const auto before = e > 0 ? e - 1 : row.size() - 1, after = e + 1 < row.size() ? e + 1 : 0;
      const auto span = edgeSpan(sites_, static_cast<std::int32_t>(cell), row[before], row[e], row[after],
                                 corners[e], corners[after]);
      longest_[vertex] = std::max(longest_[vertex], span.slack);
    }
  }

  /// Those around vertices that are so many ties wide.
  std::vector<std::uint32_t> cellsAt(double most) {
    std::vector<std::uint32_t> cells;
    for (std::size_t v = 0; v < width_.size(); ++v) {
      if (!(width_[v] > most * longest_[v])) continue;
      for (auto at = tied_.around_first[v]; at < tied_.around_first[v + 1]; ++at) {
        if (fineness_.of(tied_.around[at]) < Fineness::finest) cells.push_back(tied_.around[at]);
      }
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
  }

  const ProposedCells& proposed_;
  const SiteSet& sites_;
  const TiedCells& tied_;
  const Fineness& fineness_;
  std::vector<std::uint32_t> ties_;      ///< by vertex, twice
  std::vector<double> longest_, width_;  ///< by vertex: its longest tie, and how far its corners are from it
};

}  // namespace

WideVertices findWideVertices(const ProposedCells& proposed, const TiedCells& tied,
                              const Fineness& fineness) {
  return Measuring(proposed, tied, fineness).run();
}

}  // namespace vorpipe
