#include "core/grid_topology.h"

#include "backend/collect.h"
#include "core/pace.h"
#include "core/sample.h"
#include "core/upload.h"
#include "parallel.h"

namespace vorpipe {
namespace {

constexpr std::size_t grain = std::size_t{1} << 16;

using Indices = std::vector<std::uint32_t>;

class Finding {
 public:
  Finding(const TopologyInput& input, std::size_t cells, Topology& topology, Report& report)
      : input_(input), cells_(cells), upload_(input.backend, {}), topology_(topology), report_(report) {}

  Result<void> findTile(const Tile& tile) {
    if (areMany(0)) return leave(tile, tile.own);
    if (auto given = upload_.give(tile); !given) return given;
    const Sample sample(tile.own);
    const auto before = left.size();
    if (auto found = findAll(tile, sample.cells); !found) return found;
    const auto failed = left.size() - before;
    const bool left_to_judge = sample.isHopeless(failed) || areMany(sample.expected(failed));
    return left_to_judge ? leave(tile, sample.rest) : findAll(tile, sample.rest);
  }

  /// Whether the cells that are left, with some more and those never asked for, are worth the mesh of all.
  [[nodiscard]] bool areMany(std::size_t more) const {
    return input_.judge.areMany(left.size() + more + (input_.sites.size() - cells_));
  }

  [[nodiscard]] double uploadSeconds() const { return upload_.seconds(); }

  Indices left;  ///< in the whole set; neither certified nor worth another try on the device

 private:
  Result<void> findAll(const Tile& tile, std::span<const std::uint32_t> which) {
    Indices full;
    if (auto found = find(tile, which, Effort::fast, "cells", full); !found) return found;
    report_.retried += full.size();
    if (auto found = find(tile, full, Effort::roomy, "large cells", full); !found) return found;
    done_ += which.size();
    return {};
  }

  /// What the mesh finds on the way.
  Result<void> leave(const Tile& tile, std::span<const std::uint32_t> which) {
    for (const auto site : which) left.push_back(tile.wholeIndex(site));
    done_ += which.size();
    return {};
  }

  /// Replaces `full` by the cells that need more room than a fast try has.
  Result<void> find(const Tile& tile, std::span<const std::uint32_t> which, Effort effort, const char* stage,
                    Indices& full) {
    Indices overflown;
    const auto work = [&](std::size_t begin, std::size_t count) -> Result<void> {
      const auto part = which.subspan(begin, count);
      Neighborhoods found;
      if (auto done = input_.backend.cells(part, effort, found); !done) return done;
      for (std::size_t e = 0; e < count; ++e) {
        if (isDone(found.status[e])) continue;
        const bool again = effort == Effort::fast && found.status[e] == CellStatus::overflow;
        (again ? overflown : left).push_back(again ? part[e] : tile.wholeIndex(part[e]));
      }
      add(tile, part, std::move(found));
      return {};
    };
    const auto most = input_.backend.info().max_entries;
    const Stretch stretch{which.size(), done_, cells_};
    if (auto done = inSteps(input_.progress, stage, stretch, most, work); !done) return done;
    full = std::move(overflown);
    return {};
  }

  void add(const Tile& tile, std::span<const std::uint32_t> part, Neighborhoods found) {
    if (tile.whole.empty()) return topology_.add(part, std::move(found));
    Indices whole;
    for (const auto site : part) whole.push_back(tile.whole[site]);
    parallelFor(part.size(), grain, input_.threads, [&](std::size_t begin, std::size_t end) {
      for (auto e = begin; e < end; ++e) {
        renumber(found, e, [&](std::uint32_t site) { return tile.whole[site]; });
      }
    });
    topology_.add(whole, std::move(found));
  }

  const TopologyInput& input_;
  std::size_t cells_;  ///< of all tiles
  std::size_t done_ = 0;
  Upload upload_;
  Topology& topology_;
  Report& report_;
};

}  // namespace

Result<Indices> findByGrid(const TopologyInput& input, std::span<const std::uint32_t> which,
                           Topology& topology, Report& report) {
  Finding finding(input, which.size(), topology, report);
  auto unfit = forTiles(
      input.sites, input.backend.info(), which, input.threads,
      [&](const Tile& tile) { return finding.findTile(tile); }, [&] { return finding.areMany(0); });
  if (!unfit) return unfit;
  report.time_ms.upload = 1e3 * finding.uploadSeconds();
  finding.left.insert(finding.left.end(), unfit->begin(), unfit->end());
  return std::move(finding.left);
}

}  // namespace vorpipe
