#include "core/search/list_search.h"

#include <algorithm>

#include "backend/collect.h"
#include "base/progress_steps.h"
#include "core/judge/answers.h"
#include "core/search/bisectors.h"
#include "core/search/flann_search.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t lines_per_batch = std::size_t{1} << 20;

using Indices = std::vector<std::uint32_t>;

class Finding {
 public:
  Finding(const SearchInput& input, NeighborRows& rows, Report& report)
      : input_(input), rows_(rows), report_(report), search_(input.sites, input.threads) {
    report_.time_ms.search = 1e3 * watch_.seconds();
  }

  Result<Indices> find(Indices pending) {
    Indices left;
    const auto most = std::min<std::uint64_t>(FlannSearch::most_neighbors, input_.backend.info().max_lines);
    for (auto k = std::min<std::size_t>(static_cast<std::size_t>(input_.search.neighbors), most);; k *= 2) {
      Indices unsecured;
      if (auto done = round(pending, k, unsecured, left); !done) return tl::unexpected(done.error());
      const bool helped = k < FlannSearch::usual_neighbors || 2 * unsecured.size() <= pending.size();
      pending = std::move(unsecured);
      if (pending.empty()) break;
      if (!helped || 2 * k > most) {
        left.insert(left.end(), pending.begin(), pending.end());
        break;
      }
      report_.retried += pending.size();
    }
    return left;
  }

 private:
  Result<void> round(std::span<const std::uint32_t> which, std::size_t k, Indices& unsecured, Indices& left) {
    const auto& info = input_.backend.info();
    const auto lines = std::min<std::uint64_t>(info.max_lines, lines_per_batch);
    const auto at_once = std::clamp<std::size_t>(lines / k, 1, info.max_entries);
    return runInSteps(input_.progress, "cells", which.size(), at_once,
                      [&](std::size_t begin, std::size_t count) -> Result<void> {
                        const auto part = which.subspan(begin, count);
                        CellNeighbors found;
                        if (auto done = clip(part, k, found); !done) return done;
                        for (std::size_t e = 0; e < count; ++e) {
                          if (isDone(found.status[e])) continue;
                          (found.status[e] == CellStatus::unsecured ? unsecured : left).push_back(part[e]);
                        }
                        rows_.add(part, std::move(found));
                        return {};
                      });
  }

  /// Clips by the k nearest neighbors, and turns places in lists into sites.
  Result<void> clip(std::span<const std::uint32_t> which, std::size_t k, CellNeighbors& found) {
    const Stopwatch watch;
    const auto candidates = search_.neighbors(which, k);
    packBatch(input_.sites, candidates, 0, which.size(), input_.threads, batch_);
    report_.time_ms.search += 1e3 * watch.seconds();
    if (auto clipped = askCells(input_.backend, batch_, input_.threads, found); !clipped) return clipped;
    for (std::size_t e = 0; e < which.size(); ++e) {
      renumber(found, e, [&](std::uint32_t line) { return candidates.index[candidates.offsets[e] + line]; });
    }
    return {};
  }

  const SearchInput& input_;
  NeighborRows& rows_;
  Report& report_;
  Stopwatch watch_;
  FlannSearch search_;
  CellBatch<double> batch_;
};

}  // namespace

Result<Indices> findByLists(const SearchInput& input, std::span<const std::uint32_t> which,
                            NeighborRows& rows, Report& report) {
  if (which.empty()) return Indices{};
  return Finding(input, rows, report).find({which.begin(), which.end()});
}

}  // namespace vorpipe::core
