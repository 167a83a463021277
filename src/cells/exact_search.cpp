#include "cells/exact_search.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "base/parallel.h"
#include "base/progress_steps.h"
#include "base/try.h"
#include "cells/site_mesh.h"

namespace vorpipe::core {
namespace {

/// Break-even: the mesh of n sites takes as long as n / sites_per_cell cells in double, from trees of the
/// sites around them, or as n / sites_per_exact_cell cells exactly: some 0.35 us a site, more with weights;
/// a tree of all sites takes as long as the mesh.
constexpr std::size_t sites_per_cell = 256, sites_per_weighted_cell = 64, sites_per_exact_cell = 2048;

/// Up to this many sites with weights, the mesh is made even for a single cell: if all cells nearly meet in a
/// point, that cell may take minutes with many digits.
constexpr std::size_t few_weighted_sites = std::size_t{1} << 14;

/// Cells between two calls of progress.
constexpr std::size_t most_at_once = std::size_t{1} << 24;

using Indices = std::vector<std::uint32_t>;

}  // namespace

void ExactSearch::addFromMesh(const PartMesh& mesh, std::span<const std::uint32_t> which, int threads,
                              NeighborRows& cells) const {
  std::vector<std::uint8_t> is_wanted(sites_.size());
  Indices entry(sites_.size());
  for (std::uint32_t e = 0; e < which.size(); ++e) {
    is_wanted[which[e]] = 1;
    entry[which[e]] = e;
  }
  for (auto& part : meshCells(sites_, mesh, is_wanted, threads)) {
    for (auto& site : part.site) site = entry[site];
    cells.add(part.site, std::move(part.cells));
  }
}

Result<NeighborRows> ExactSearch::find(std::span<const std::uint32_t> which, Precision precision, int threads,
                                       const Progress& progress, std::uint64_t& exact) {
  NeighborRows cells(which.size(), threads);
  const bool few = !sites_.weight.empty() && sites_.size() <= few_weighted_sites && mesh_.isPossible();
  const bool pays = precision == Precision::exact
                        ? few || (!mesh_.isMade() && which.size() > sites_.size() / sites_per_exact_cell)
                        : mesh_.isMade() || areMany(which.size());
  if (const auto* mesh = pays ? mesh_.get() : nullptr; mesh != nullptr) {
    addFromMesh(*mesh, which, threads, cells);
    return cells;
  }
  auto found = findAlone(which, precision, progress, cells);
  if (found && precision == Precision::in_double && !found->empty()) {
    Indices open;
    for (const auto e : *found) open.push_back(which[e]);
    auto exactly = find(open, Precision::exact, threads, progress, exact);
    if (!exactly) return exactly;
    exact += open.size();
    cells.add(*found, std::move(*exactly));
    return cells;
  }
  if (!found) return tl::unexpected(found.error());
  assert(found->empty());
  return cells;
}

bool ExactSearch::findAmong(std::span<const std::uint32_t> which, int threads, NeighborRows& rows) {
  constexpr std::size_t grain = std::size_t{1} << 15;
  if (!mesh_.isPossible()) return false;
  std::vector<std::uint8_t> is_wanted(sites_.size());
  for (const auto site : which) is_wanted[site] = 1;
  const auto add = [&](const PartMesh& mesh) {
    for (auto& part : meshCells(sites_, mesh, is_wanted, threads)) rows.add(part.site, std::move(part.cells));
    return true;
  };
  if (mesh_.isMade()) {
    const auto* mesh = mesh_.get();
    return mesh != nullptr && add(*mesh);
  }
  std::vector<Indices> beside((sites_.size() + grain - 1) / grain);
  parallelFor(sites_.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      const auto edges = rows.edges(i);
      const bool names_one = std::ranges::any_of(
          edges, [&](auto other) { return other < 0 || is_wanted[static_cast<std::size_t>(other)] != 0; });
      if (is_wanted[i] != 0 || names_one) beside[begin / grain].push_back(static_cast<std::uint32_t>(i));
    }
  });
  Indices some;
  for (const auto& part : beside) some.insert(some.end(), part.begin(), part.end());
  const auto mesh = triangulate(sites_, std::move(some), threads);
  return !mesh.mesh.triangles.empty() && add(mesh);
}

ExactTier& ExactSearch::ready() {
  if (!ready_) exact_.take(sites_);
  ready_ = true;
  return exact_;
}

void ExactSearch::nearest(const View& view, std::span<const std::uint32_t> pixels,
                          std::span<std::uint32_t> sites) {
  ready().nearest(view, pixels, sites);
}

bool ExactSearch::areMany(std::size_t cells) const {
  const auto sites = sites_.weight.empty() ? sites_per_cell : sites_per_weighted_cell;
  return cells > sites_.size() / sites && mesh_.isPossible();
}

Result<std::vector<std::uint32_t>> ExactSearch::findAlone(std::span<const std::uint32_t> which,
                                                          Precision precision, const Progress& progress,
                                                          NeighborRows& cells) {
  Indices entries(which.size()), open;
  std::iota(entries.begin(), entries.end(), 0u);
  const auto work = [&](std::size_t begin, std::size_t count) -> Result<void> {
    CellNeighbors found;
    ready().cells(which.subspan(begin, count), precision, found);
    for (std::size_t e = 0; e < count; ++e) {
      if (!isDone(found.status[e])) open.push_back(entries[begin + e]);
    }
    cells.add(std::span(entries).subspan(begin, count), std::move(found));
    return {};
  };
  const auto* stage = precision == Precision::exact ? "exact cells" : "cells in double";
  VORPIPE_TRY(runInSteps(progress, stage, entries.size(), most_at_once, work));
  return open;
}

}  // namespace vorpipe::core
